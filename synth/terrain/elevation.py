"""Elevation models: heights of ground read from a file."""

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import tifffile
from scipy import ndimage as ndi

from synth.arrays import Floats
from synth.errors import SpecError
from synth.spec.terrain import TerrainSpec

_SCALE_TAG, _NO_DATA_TAG = 33550, 42113  # ModelPixelScale, GDAL_NODATA
_LEAST = 2  # rows and columns


@dataclass(frozen=True, eq=False)
class Elevation:
    """Elevation model: heights on square cells, its middle at the origin, row 0 the northernmost.

    x runs along the columns, y against the rows.
    """

    height_m: Floats  # (rows, cols), 0 at the middle
    cell_m: float

    @property
    def half_m(self) -> float:
        """Half of the longer side."""
        rows, columns = self.height_m.shape
        longest: int = max(rows, columns)
        return self.cell_m * (longest - 1) / 2.0

    def heights_m(self, places_m: Floats) -> Floats:
        """Heights at places (..., 2), linear between cells; beyond the edge those of the edge."""
        rows, columns = self.height_m.shape
        column = places_m[..., 0] / self.cell_m + (columns - 1) / 2.0
        row = (rows - 1) / 2.0 - places_m[..., 1] / self.cell_m
        return np.asarray(
            ndi.map_coordinates(self.height_m, [row, column], order=1, mode="nearest")
        )


def read_elevation(spec: TerrainSpec) -> Elevation:
    """Elevation model of a spec: GeoTIFF or TIFF, `.npy`, or a PNG of 16 bits.

    Raises:
        SpecError: the file cannot be read, is no grid of heights, does not tell the size of its
            cells, or misses heights and the spec does not say to fill them.
    """
    path = Path(spec.elevation)
    where = f"ground.terrain.elevation: {path}"
    reader = {".npy": _npy, ".png": _png, ".tif": _tiff, ".tiff": _tiff}.get(path.suffix.lower())
    if reader is None:
        raise SpecError(f"{where}: expected .tif, .tiff, .npy or .png, found {path.suffix!r}")
    try:
        values, cell_m, no_data = reader(path)
    except (OSError, ValueError, EOFError, tifffile.TiffFileError) as error:
        raise SpecError(f"{where}: expected a grid of heights, found {error}") from error
    if values.ndim != 2 or min(values.shape) < _LEAST or values.dtype.kind not in "iuf":
        raise SpecError(
            f"{where}: expected heights (rows, cols), at least 2 × 2, "
            f"found {values.dtype} of shape {values.shape}"
        )
    cell_m = spec.elevation_cell_m if spec.elevation_cell_m is not None else cell_m
    if cell_m is None:
        raise SpecError(
            f"ground.terrain.elevation_cell_m: expected metres per cell, since {path} "
            "does not tell them, found none"
        )
    height_m = values.astype(np.float64)
    missing = ~np.isfinite(height_m)
    if no_data is not None:
        missing |= height_m == no_data
    height_m = _whole(spec.elevation_step_m * height_m, missing, spec, where)
    grid = Elevation(height_m=height_m, cell_m=cell_m)
    return Elevation(height_m=height_m - grid.heights_m(np.zeros((1, 2))), cell_m=cell_m)


def _whole(
    height_m: Floats,
    missing: np.ndarray[tuple[int, ...], np.dtype[np.bool_]],
    spec: TerrainSpec,
    where: str,
) -> Floats:
    """Heights without gaps: each takes the nearest height there is."""
    if not missing.any():
        return height_m
    if missing.all() or spec.elevation_gaps == "refuse":
        fill = "" if missing.all() else '; elevation_gaps = "fill" takes the nearest ones'
        raise SpecError(
            f"{where}: expected a height in every cell{fill}, "
            f"found {int(missing.sum())} of {missing.size} missing"
        )
    rows, columns = ndi.distance_transform_edt(missing, return_distances=False, return_indices=True)
    return np.asarray(height_m[rows, columns])


def _npy(path: Path) -> tuple[np.ndarray, float | None, float | None]:
    return np.load(path, allow_pickle=False), None, None


def _png(path: Path) -> tuple[np.ndarray, float | None, float | None]:
    values = cv2.imdecode(np.fromfile(path, dtype=np.uint8), cv2.IMREAD_UNCHANGED)
    if values is None or values.dtype != np.uint16:
        raise ValueError("no PNG of 16 bits")
    return values, None, None


def _tiff(path: Path) -> tuple[np.ndarray, float | None, float | None]:
    """Heights, metres per cell as a GeoTIFF's scale has them, and the value of missing ones."""
    with tifffile.TiffFile(path) as file:
        values, tags = file.pages[0].asarray(), file.pages[0].aspage().tags
        scale, no_data = (
            None if code not in tags else tags[code].value for code in (_SCALE_TAG, _NO_DATA_TAG)
        )
    if scale is not None and not np.isclose(scale[0], scale[1]):
        raise ValueError(f"cells of {scale[0]:g} by {scale[1]:g}")
    cell_m = None if scale is None else float(scale[0])
    return values, cell_m, None if no_data is None else float(str(no_data).strip("\0 "))
