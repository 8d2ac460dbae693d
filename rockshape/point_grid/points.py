"""Points of an image's pixels from z-depth, distance along the ray, disparity or points."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.errors import InputError
from rockshape.point_grid.missing import missing_in_points, missing_in_raster
from rockshape.point_grid.units import RangeScale, check_distance

RangeKind = Literal["depth", "distance", "disparity", "xyz"]
KINDS: tuple[RangeKind, ...] = get_args(RangeKind)
MAX_MISS_PX = 3.0  # median distance of points from their pixels, of points in the camera's frame
MAX_MISS_SHARE = 0.01  # of the image's width, likewise


@dataclass(frozen=True, eq=False)
class PointReading:
    """Points seen at each pixel, and how many values were no measurement."""

    points_m: NDArray[np.float64]  # (rows, cols, 3), NaN where nothing was measured
    left_out: Mapping[str, int]  # pixels by reason


def points_from(
    values: NDArray[np.generic],
    *,
    kind: RangeKind,
    camera: Camera | None,
    scale: RangeScale,
    no_data: tuple[float, ...] = (),
) -> PointReading:
    """Points (rows, cols, 3), m, of a raster of the kind.

    - values: (rows, cols), or (rows, cols, 3) of kind `xyz`, in units of the scale.
    - camera: what took the image; `xyz` does without.
    - no_data: constants that stand for no measurement, beside those that always do.

    Raises: InputError where values are no numbers or not of the kind's shape, a camera is missing,
        points are not in the camera's frame, or no scene lies at such a distance.
    """
    if values.dtype.kind not in "fiu":
        raise InputError(f"expected numbers, found {values.dtype}")
    if values.dtype == np.float16:
        values = values.astype(np.float32)
    find_missing = missing_in_points if kind == "xyz" else missing_in_raster
    missing = find_missing(values, no_data=no_data)
    metres = values.astype(np.float64) * scale.metres
    for mask in missing.values():
        metres[mask] = np.nan
    points_m = metres if kind == "xyz" else _along_rays(metres, kind, camera)
    points_m[~np.isfinite(points_m).all(axis=-1)] = np.nan
    left_out = {reason: int(np.count_nonzero(mask)) for reason, mask in missing.items()}
    if kind == "xyz" and camera is not None:
        left_out |= _behind(points_m)
        _check_frame(points_m, camera)
    check_distance(points_m, scale)
    return PointReading(points_m, left_out)


def _along_rays(
    metres: NDArray[np.float64], kind: RangeKind, camera: Camera | None
) -> NDArray[np.float64]:
    if camera is None:
        name = "z-depth" if kind == "depth" else kind
        raise InputError(f"{name}: expected a camera (--camera) to turn it into points, found none")
    if kind == "depth":
        return camera.unproject(metres)
    rays = camera.unproject(np.ones(camera.shape))
    return np.asarray(rays * (metres / np.sqrt((rays**2).sum(axis=-1)))[..., None])


def _behind(points_m: NDArray[np.float64]) -> dict[str, int]:
    """Take out points behind the camera, where no pixel can see one; how many there were.

    Raises: InputError where most are.
    """
    behind = points_m[..., 2] <= 0
    count = int(np.count_nonzero(behind))
    if not count:
        return {}
    known = int(np.count_nonzero(np.isfinite(points_m[..., 2])))
    if count > known / 2:
        raise InputError(
            f"points: expected them in the camera's frame, x right, y down, z forward, found "
            f"{count} of {known} behind the camera; without --camera it is found from the points"
        )
    points_m[behind] = np.nan
    return {"behind the camera": count}


def _check_frame(points_m: NDArray[np.float64], camera: Camera) -> None:
    """Raises: InputError where the points do not project to their own pixels."""
    row, col = np.nonzero(np.isfinite(points_m[..., 2]))
    if not len(row):
        return
    misses = camera.project(points_m[row, col]) - np.column_stack([col, row])
    median = float(np.median(np.hypot(*misses.T)))
    most = max(MAX_MISS_PX, MAX_MISS_SHARE * camera.width)
    if median > most:
        raise InputError(
            f"points: expected them in the camera's frame, x right, y down, z forward, found a "
            f"median of {median:.3g} px from their pixels; without --camera it is found from them"
        )
