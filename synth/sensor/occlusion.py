"""Holes of stereo: half-occluded surfaces, and surfaces without texture."""

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats, Mask

_STEP_PX = 1.0  # a surface nearer by more than this disparity hides what is behind it


def half_occluded(disparity_px: Floats) -> Mask:
    """Half-occlusion mask: left pixels, (rows, cols), that the right eye does not see.

    Each pixel lands d columns to the left in the right image, between two of its columns, and
    claims both; the greatest disparity wins a column. A pixel is hidden where both of its columns
    went to a surface nearer by more than one pixel of disparity, and where it lands outside the
    frame. NaN (sky) is hidden.
    """
    rows, cols = disparity_px.shape
    known = ~np.isnan(disparity_px)
    landing = np.arange(cols) - np.where(known, disparity_px, 0.0)
    first = np.floor(landing).astype(np.int64)
    row = np.broadcast_to(np.arange(rows)[:, None], (rows, cols))
    nearest = np.full((rows, cols + 2), -np.inf)  # a column to spare on either side
    places = [np.clip(first + side, -1, cols) + 1 for side in (0, 1)]
    for place in places:
        np.maximum.at(nearest, (row[known], place[known]), disparity_px[known])
    covered = np.minimum(nearest[row, places[0]], nearest[row, places[1]])
    hidden = covered > np.where(known, disparity_px, np.inf) + _STEP_PX
    outside = (landing < -0.5) | (landing > cols - 0.5)
    return np.asarray(hidden | outside | ~known)


def contrast(light: NDArray[np.floating], window_px: int) -> Floats:
    """RMS change from a column to the next over a window, grey levels of 255.

    Only changes along the row tell a match from its neighbours.
    """
    levels = 255.0 * np.clip(light, 0.0, 1.0).astype(np.float64)
    steps = np.diff(levels, axis=1, append=levels[:, -1:])
    mean_square = cv2.boxFilter(steps**2, -1, (window_px, window_px))
    return np.asarray(np.sqrt(np.maximum(mean_square, 0.0)))
