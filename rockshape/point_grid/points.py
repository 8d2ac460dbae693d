"""Points of an image's pixels from z-depth, distance along the ray, disparity or points."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.lens import Lens
from rockshape.errors import InputError
from rockshape.numerics.arrays import Floats
from rockshape.point_grid.missing import missing_in_points, missing_in_raster
from rockshape.point_grid.units import RangeScale, check_distance

RangeKind = Literal["depth", "distance", "disparity", "xyz"]
KINDS: tuple[RangeKind, ...] = get_args(RangeKind)
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
    find_missing = missing_in_points if kind == "xyz" else missing_in_raster
    missing = find_missing(values, no_data=no_data)
    known = values.astype(np.float64)
    for mask in missing.values():
        known[mask] = np.nan
    if kind == "disparity":  # the unit is the baseline's
        known *= _disparity_step(values, camera)
        points_m = _along_rays(known, kind, camera) * scale.metres
    elif kind == "xyz":
        points_m = known * scale.metres
    else:
        points_m = _along_rays(known * scale.metres, kind, camera)
    points_m[~np.isfinite(points_m).all(axis=-1)] = np.nan
    left_out = {reason: int(np.count_nonzero(mask)) for reason, mask in missing.items()}
    if kind == "xyz" and camera is not None:
        points_m = points_m if camera.pose is None else camera.pose.to_camera(points_m)
        left_out |= _behind(points_m)
        _check_frame(points_m, camera)
    check_distance(points_m, scale)
    return PointReading(points_m, left_out)


def _along_rays(values: Floats, kind: RangeKind, camera: Lens | None) -> Floats:
    """Points (rows, cols, 3) of depth or distance, m, or of disparity, px."""
    if camera is None:
        name = "z-depth" if kind == "depth" else kind
        raise InputError(
            f"{name}: expected a camera (camera, --camera) to turn it into points, found none"
        )
    rays = camera.rays()
    if kind == "distance":
        values = values / np.sqrt((rays**2).sum(axis=-1))
    if kind == "disparity":
        values = _depth_of(values, camera)
    return np.asarray(rays * values[..., None])


def _depth_of(disparity: Floats, camera: Lens) -> Floats:
    """Z-depth (rows, cols), m, of disparity in px."""
    if camera.disparity is None:
        raise InputError(
            "disparity: expected a baseline in the camera file (baseline_m, Q or the like), "
            "found none"
        )
    if not camera.is_pinhole:
        raise InputError(
            "disparity: expected the camera of rectified images, found one with distortion or skew"
        )
    known = disparity + camera.disparity.offset_px
    known = np.where(known > 0, known, np.nan)
    return np.asarray(camera.pinhole.fx * camera.disparity.baseline_m / known)


def _disparity_step(values: NDArray[np.generic], camera: Lens | None) -> float:
    """Pixels of disparity in one of its values."""
    if camera is None or camera.disparity is None or values.dtype.kind == "f":
        return 1.0
    if camera.disparity.step_px is None:
        raise InputError(
            "disparity in whole steps: expected disparity_scale, px a step, in the camera file "
            "(0.0625 of OpenCV's matchers, 0.00390625 of KITTI), found none"
        )
    return camera.disparity.step_px


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
