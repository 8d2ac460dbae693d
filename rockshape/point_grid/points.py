"""Points of an image's pixels from z-depth, distance along the ray, disparity or points."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.lens import Lens
from rockshape.errors import InputError
from rockshape.numerics.arrays import Floats
from rockshape.point_grid.range_kinds import QUANTITIES, KnownRange, RangeKind
from rockshape.point_grid.units import RangeScale, check_distance

MIN_DEPTH_M = 1e-6  # in front of the camera; what is nearer lies behind it but for rounding
MAX_MISS_PX = 3.0  # median distance of points from their pixels, of points in the camera's frame
MAX_MISS_SHARE = 0.01  # of the image's width, likewise


@dataclass(frozen=True, eq=False)
class PointReading:
    """Points seen at each pixel, and how many values were no measurement."""

    points_m: Floats  # (rows, cols, 3), NaN where nothing was measured
    left_out: Mapping[str, int]  # pixels by reason


def points_from(
    values: NDArray[np.generic],
    *,
    kind: RangeKind,
    camera: Lens | None,
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
    if camera is not None and camera.shape != values.shape[:2]:
        raise InputError(f"camera: expected {values.shape[:2]} as range has, found {camera.shape}")
    if values.dtype.kind == "f":
        with np.errstate(invalid="ignore"):  # of signalling NaN, which damaged files hold
            precise = values.astype(np.float32 if values.dtype == np.float16 else values.dtype)
            values = np.where(np.isnan(precise), precise.dtype.type(np.nan), precise)
    quantity = QUANTITIES[kind]
    missing = quantity.find_missing(values, no_data=no_data)
    known = values.astype(np.float64)
    for mask in missing.values():
        known[mask] = np.nan
    whole = values.dtype.kind != "f"
    points_m = quantity.to_points(KnownRange(known, whole, camera, scale))
    points_m[~np.isfinite(points_m).all(axis=-1)] = np.nan
    left_out = {reason: int(np.count_nonzero(mask)) for reason, mask in missing.items()}
    if quantity.is_in_frame and camera is not None:
        points_m = points_m if camera.pose is None else camera.pose.to_camera(points_m)
        left_out |= _behind(points_m)
        _check_frame(points_m, camera)
    check_distance(points_m, scale)
    return PointReading(points_m, left_out)


def _behind(points_m: Floats) -> dict[str, int]:
    """Take out points behind the camera, where no pixel can see one; how many there were.

    Raises: InputError where most are.
    """
    behind = points_m[..., 2] <= MIN_DEPTH_M
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


def _check_frame(points_m: Floats, camera: Lens) -> None:
    """Raises: InputError where the points do not project to their own pixels."""
    row, col = np.nonzero(np.isfinite(points_m[..., 2]))
    if not len(row):
        return
    misses = camera.project(points_m[row, col]) - np.column_stack([col, row])
    median = float(np.median(np.hypot(*misses.T)))
    most = max(MAX_MISS_PX, MAX_MISS_SHARE * camera.shape[1])
    if median > most:
        raise InputError(
            f"points: expected them in the camera's frame, x right, y down, z forward, found a "
            f"median of {median:.3g} px from their pixels; without --camera it is found from them"
        )
