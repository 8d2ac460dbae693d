"""Real stereo: two pictures matched by OpenCV's semi-global block matching."""

import cv2
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bytes = NDArray[np.uint8]

_STEPS = 16  # OpenCV's disparities count sixteenths of a pixel
_GRANULE = 16  # and their number is a multiple of this
_MARGIN = 0.2  # the search reaches this much beyond the scene's own disparities
_SMALL, _LARGE = 2, 8  # penalties of a change of disparity by 1 and by more, per pixel of window
_AGREE_PX = 1  # left to right and right to left may differ by this much
_UNIQUE_PERCENT = 5  # by which the best match must beat the second
_SPECKLE_PX, _SPECKLE_STEP_PX = 60, 2  # islands smaller than this, cut off by such a step, go
_COST_BYTES = 4  # of memory for each pixel and disparity
_MAX_BYTES = 10**9
_OVERLAP_ROWS = 48  # bands of rows are matched with this much of their neighbours


def search_range_px(disparity_px: Floats) -> tuple[int, int]:
    """Return the least disparity to try and their number, a multiple of 16."""
    low = max(0, int(np.floor(np.nanmin(disparity_px) * (1.0 - _MARGIN))))
    high = int(np.ceil(np.nanmax(disparity_px) * (1.0 + _MARGIN))) + 1
    return low, _GRANULE * int(np.ceil((high - low) / _GRANULE))


def _to_nearest(steps: NDArray[np.int16]) -> Floats:
    """Return OpenCV's disparities, in sixteenths, as rounding to the nearest would have them.

    OpenCV adds a half to the parabola's offset from the best whole disparity and cuts towards
    zero, so a negative offset is a step too great: 9 … 15 sixteenths stand for one less, and 0,
    which collects the offsets from −1.5 to 0.5, for half a step less on the mean.
    """
    part = steps % _STEPS
    return np.asarray(steps - np.where(part == 0, 0.5, part > _STEPS // 2))


def matched_disparity_px(
    left: Bytes, right: Bytes, *, least_px: int, count: int, window_px: int
) -> Floats:
    """Return the left picture's disparity, (rows, cols), to a fraction of a pixel; NaN in holes.

    Semi-global matching (Hirschmüller 2008) over eight directions, a parabola through the costs,
    the check from right to left, unique matches, no speckles. Five directions from above would
    lag behind where the ground comes nearer from row to row: on a plain they are 0.1 to 0.3 px
    short. Where the costs need too much memory, bands of rows are matched one after another.

    OpenCV leaves out the columns whose search would leave the right picture; both are widened by
    it first, and what then lands outside the right picture is a hole.
    """
    rows, cols = left.shape
    wide = least_px + count
    matcher = cv2.StereoSGBM.create(
        minDisparity=least_px,
        numDisparities=count,
        blockSize=window_px,
        P1=_SMALL * window_px**2,
        P2=_LARGE * window_px**2,
        disp12MaxDiff=_AGREE_PX,
        uniquenessRatio=_UNIQUE_PERCENT,
        speckleWindowSize=_SPECKLE_PX,
        speckleRange=_SPECKLE_STEP_PX,
        mode=cv2.StereoSGBM_MODE_HH,
    )
    band = max(_OVERLAP_ROWS, _MAX_BYTES // (_COST_BYTES * (cols + wide) * count))
    steps = np.empty((rows, cols), dtype=np.int16)
    for start in range(0, rows, band):
        top, bottom = max(0, start - _OVERLAP_ROWS), min(rows, start + band + _OVERLAP_ROWS)
        pair = [
            cv2.copyMakeBorder(eye[top:bottom], 0, 0, wide, 0, cv2.BORDER_REPLICATE)
            for eye in (left, right)
        ]
        found = matcher.compute(pair[0], pair[1])[:, wide:]
        stop = min(rows, start + band)
        steps[start:stop] = found[start - top : stop - top]
    disparity_px = _to_nearest(steps) / _STEPS
    landing = np.arange(cols) - disparity_px
    matched = (steps >= _STEPS * least_px) & (disparity_px > 0.0) & (landing >= -0.5)
    return np.where(matched, disparity_px, np.nan)
