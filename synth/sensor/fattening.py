"""Foreground fattening: matching windows at depth edges take the nearer surface's disparity."""

import cv2
import numpy as np

from synth.arrays import Floats

_STEP_PX = 1.0  # neighbours whose disparities differ by more lie on different surfaces


def fattened_px(disparity_px: Floats, reach_px: int) -> Floats:
    """Disparity, (rows, cols), with every depth edge moved so many pixels out of the near surface.

    Within the reach of a pixel at whose side the disparity falls by more than one pixel, what is
    farther takes that pixel's disparity; the nearest surface wins. NaN (sky) is farthest.
    """
    if reach_px == 0:
        return disparity_px
    known = np.nan_to_num(disparity_px, nan=0.0)
    edge = known - cv2.erode(known, np.ones((3, 3), np.uint8)) > _STEP_PX
    side = 2 * reach_px + 1
    near = cv2.dilate(np.where(edge, known, 0.0), np.ones((side, side), np.uint8))
    return np.where(near - known > _STEP_PX, near, disparity_px)
