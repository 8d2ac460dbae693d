"""Map coordinates that a GeoTIFF tells for its pixels.

Source: OGC GeoTIFF 1.1 (19-008r4), tags 33550, 33922, 34264, 34735 and keys 1024, 1025, 2048, 3072.
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from rockshape.camera.map_frame import MapFrame
from rockshape.io.decoding.tiff_pixel_size import (
    KEYS,
    MODEL_TYPE,
    PIXEL_SCALE,
    PROJECTED,
    PROJECTED_SYSTEM,
    TRANSFORM,
    geo_keys,
)

if TYPE_CHECKING:
    from tifffile import TiffPage

TIE_POINTS = 33922
RASTER_TYPE, GEODETIC_SYSTEM = 1025, 2048
AT_CENTRES = 2  # raster type: a pixel's coordinates are its centre's
USER_DEFINED = 32767


def map_frame(page: "TiffPage") -> MapFrame | None:
    """Map frame of a page's pixels; None where the file has none, or ties pixels one by one."""
    matrix = _matrix(page)
    if page.tags.valueof(KEYS) is None or matrix is None or not _turns_back(matrix):
        return None
    keys = geo_keys(page)
    key = PROJECTED_SYSTEM if keys.get(MODEL_TYPE) == PROJECTED else GEODETIC_SYSTEM
    system = keys.get(key, USER_DEFINED)
    if keys.get(RASTER_TYPE) != AT_CENTRES:  # raster coordinates begin at a corner
        matrix[:, 2] += matrix[:, :2] @ [0.5, 0.5]
    return MapFrame(matrix, None if system in (0, USER_DEFINED) else system)


def _turns_back(matrix: Any) -> bool:
    """Whether a matrix (2, 3) maps pixels to places of their own."""
    return bool(np.isfinite(matrix).all() and np.linalg.det(matrix[:, :2]))


def _matrix(page: "TiffPage") -> Any:
    """Matrix (2, 3) from raster coordinates to the map."""
    transform, scale, ties = (
        np.ravel(page.tags.valueof(tag, default=())) for tag in (TRANSFORM, PIXEL_SCALE, TIE_POINTS)
    )
    if transform.size == 16:
        return transform.reshape(4, 4).astype(np.float64)[:2][:, [0, 1, 3]]
    if scale.size != 3 or ties.size != 6:
        return None
    i, j, _, x, y, _ = ties.tolist()
    sx, sy = scale[0], -scale[1]
    return np.array([[sx, 0.0, x - sx * i], [0.0, sy, y - sy * j]])
