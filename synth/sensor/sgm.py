"""Stereo matching: two images matched by OpenCV's semi-global block matching."""

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats
from synth.camera.pose import right_eye
from synth.sensor.exposure import eight_bits
from synth.sensor.rectify import Rectification, rectification_of
from synth.sensor.rig import rig_of
from synth.sensor.seeds import Use
from synth.sensor.sensor import Capture, Sensor, SensorInput

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
    """Search range: the least disparity to try and their number, a multiple of 16."""
    low = max(0, int(np.floor(np.nanmin(disparity_px) * (1.0 - _MARGIN))))
    high = int(np.ceil(np.nanmax(disparity_px) * (1.0 + _MARGIN))) + 1
    return low, _GRANULE * int(np.ceil((high - low) / _GRANULE))


def _to_nearest(steps: NDArray[np.int16]) -> Floats:
    """OpenCV's disparities, in sixteenths, as rounding to the nearest would have them.

    OpenCV adds a half to the parabola's offset from the best whole disparity and cuts towards
    zero, so a negative offset is a step too great: 9 … 15 sixteenths stand for one less, and 0,
    which collects the offsets from −1.5 to 0.5, for half a step less on the mean.
    """
    part = steps % _STEPS
    return np.asarray(steps - np.where(part == 0, 0.5, part > _STEPS // 2))


def matched_disparity_px(
    left: Bytes, right: Bytes, *, least_px: int, count: int, window_px: int
) -> Floats:
    """Disparity of the left image, (rows, cols), to a fraction of a pixel; NaN in holes.

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


def _straight_disparity_px(
    left: Bytes, right: Bytes, *, exact_px: Floats, window_px: int, lens: Rectification | None
) -> Floats:
    """Disparity of two images, (rows, cols), matched where the lens's are straight.

    The scene's own disparities set the range that is searched.
    """
    least_px, count = search_range_px(exact_px)
    if lens is None:
        return matched_disparity_px(
            left, right, least_px=least_px, count=count, window_px=window_px
        )
    found_px = matched_disparity_px(
        lens.straight_picture(left),
        lens.straight_picture(right),
        least_px=least_px,
        count=count,
        window_px=window_px,
    )
    found_px[~lens.seen | lens.outside_right(found_px)] = np.nan
    return lens.bent_disparity_px(found_px)


def _capture(shot: SensorInput) -> Capture:
    rig = rig_of(shot.spec.camera.preset)
    right = shot.picture_from(right_eye(shot.pose, rig.baseline_m), Use.RIGHT_PICTURE)
    disparity_px = _straight_disparity_px(
        eight_bits(shot.picture),
        eight_bits(right),
        exact_px=rig.disparity_px(shot.view.depth_m),
        window_px=shot.spec.noise.window_px,
        lens=None if shot.camera.distortion is None else rectification_of(shot.camera),
    )
    return Capture(
        picture=shot.picture,
        depth_m=rig.depth_m(disparity_px),
        pictures={"gray_right": right},
    )


SGM = Sensor(
    "sgm",
    "two rendered images, matched",
    _capture,
    pictures=("gray_right",),
    needs_baseline=True,
)
