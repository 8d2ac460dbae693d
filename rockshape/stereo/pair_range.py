"""Range of a stereo pair: the point seen at each pixel of the left picture."""

import numpy as np

from rockshape.camera.camera import as_camera, camera_object
from rockshape.camera.lens import DisparityScale, Lens
from rockshape.errors import InputError
from rockshape.numerics.arrays import Singles
from rockshape.point_grid.points import PointReading
from rockshape.point_grid.units import RangeScale, check_distance, parse_unit
from rockshape.stereo.block_matching import (
    Bytes,
    coarse_disparity,
    matched_disparity,
    search_around,
)
from rockshape.stereo.rectified_pair import RectifiedPair, rectified_pair

DARK_BRIGHT_PERCENT = (0.1, 99.9)  # of both pictures: what becomes 0 and 255
MIN_SIDE_PX = 16
MIN_MATCHED = 0.2  # of the pixels, below which the pictures are not those of a pair


def points_of_pair(
    left: Singles, right: Singles, *, camera: Lens, scale: RangeScale
) -> PointReading:
    """Points (rows, cols, 3), m, in the frame of the left camera; NaN where nothing matches.

    - left, right: grey pictures (rows, cols) of the same size, from 0 to 1.
    - camera: the left one with its baseline or its right camera, see `rectified_pair`.
    - scale: of the baseline.

    Raises: InputError where the pictures or the cameras are no pair, and where the median range is
        below 1 cm or above 200 m and the scale is not meant.
    """
    if right.shape != left.shape:
        raise InputError(f"expected {left.shape} as the left picture has, found {right.shape}")
    if camera.shape != left.shape:
        raise InputError(f"camera: expected {left.shape} as the image has, found {camera.shape}")
    if np.array_equal(left, right):
        raise InputError("expected the right picture of a pair, found the left one once more")
    pair = rectified_pair(camera)
    if min(left.shape) < MIN_SIDE_PX or not abs(pair.infinity_px) < left.shape[1]:
        raise InputError(
            f"expected pictures of at least {MIN_SIDE_PX} px a side, whose principal points differ "
            f"by less than their width, found {left.shape} and {pair.infinity_px:g} px"
        )
    levels = _eight_bits(left, right)
    pictures = _rectified(pair, levels)
    coarse = coarse_disparity(*pictures, infinity_px=pair.infinity_px)
    exchanged = coarse_disparity(*_rectified(pair, levels[::-1]), infinity_px=pair.infinity_px)
    matched = np.isfinite(coarse).mean()
    if matched < MIN_MATCHED or matched < np.isfinite(exchanged).mean():
        raise InputError(
            f"expected the right picture of a pair, found {100 * matched:.0f} % of its pixels "
            f"matched, {100 * np.isfinite(exchanged).mean():.0f} % with left and right exchanged"
        )
    search = search_around(coarse, infinity_px=pair.infinity_px)
    points_m = pair.points(matched_disparity(*pictures, search)) * scale.metres
    check_distance(points_m, scale)
    return PointReading(points_m, {})


def points_of_arrays(
    left: Singles, right: Singles, *, camera: object, unit: str | None
) -> PointReading:
    """Points of a rectified pair, whose camera has `baseline_m`; see `points_of_pair`.

    The camera may have `disparity_offset`, px, by which the right principal point lies farther
    right. unit is the baseline's in place of metres.
    """
    camera = camera_object(camera)
    baseline_m = getattr(camera, "baseline_m", None)
    if baseline_m is None:
        raise InputError("right: expected a camera with baseline_m, found none")
    disparity = DisparityScale(baseline_m, getattr(camera, "disparity_offset", 0.0))
    lens = Lens(as_camera(camera, shape=left.shape), disparity=disparity)
    scale = RangeScale() if unit is None else parse_unit(unit)
    try:
        return points_of_pair(left, right, camera=lens, scale=scale)
    except InputError as error:
        raise InputError(f"right: {error}") from None


def matching_note(reading: PointReading) -> str:
    """How many pixels of the left picture were matched, in a few words."""
    known = np.isfinite(reading.points_m[..., 2])
    return f"stereo pair: {np.count_nonzero(known)} of {known.size} pixels matched"


def _rectified(pair: RectifiedPair, levels: tuple[Bytes, Bytes]) -> tuple[Bytes, Bytes]:
    return pair.left.picture(levels[0]), pair.right.picture(levels[1])


def _eight_bits(left: Singles, right: Singles) -> tuple[Bytes, Bytes]:
    """Both pictures in 256 levels, which the same light has in both."""
    low, high = np.percentile([left, right], DARK_BRIGHT_PERCENT)
    span = max(float(high - low), 1e-6)
    levels = [np.rint(np.clip((each - low) / span, 0, 1) * 255) for each in (left, right)]
    return levels[0].astype(np.uint8), levels[1].astype(np.uint8)
