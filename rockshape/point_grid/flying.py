"""Flying pixels: points in the air between two surfaces, where a pixel has seen both."""

import numpy as np

from rockshape.numerics.arrays import Floats, Mask
from rockshape.numerics.robust_scale import MEDIAN_TO_SIGMA

STEEPEST = 8.0  # tangent of the angle of incidence, 83°, up to which surfaces are seen
NOISE = 2.5  # steps are clear above so many robust standard deviations of second differences
WIDEST_PX = 3  # of pixels that see two surfaces, side by side
ALONE = 3.0  # steps to and from them over those of the surfaces beside; 2.4 on a sphere's limb


def flying_pixels(points_m: Floats, *, pixel_rad: float) -> Mask:
    """Pixels (rows, cols) whose point lies between the surfaces before and behind it.

    - points_m: (rows, cols, 3) in the camera frame, NaN where nothing was measured.
    - pixel_rad: angle between neighbouring pixels.

    Along a row or a column, one to three pixels fly where each step to, between and from them
    leads the same way, is longer than a surface at an incidence of 83° would give and clear of
    noise and quantisation, and the surfaces before and behind are at most a third as steep. In
    inverse depth 1/Z such a surface steps by pixel_rad tan 83° / Z, and the scale of noise is the
    median of those second differences that are not zero.
    """
    inverse = 1.0 / points_m[..., 2]
    clear = NOISE * _bend(inverse)
    least = np.maximum(STEEPEST * pixel_rad * inverse, clear)
    return _between(inverse, least) | _between(inverse.T, least.T).T


def _bend(inverse: Floats) -> float:
    """Robust standard deviation of second differences along rows and columns that are not zero."""
    parts = [np.abs(np.diff(inverse, n=2, axis=axis)) for axis in (0, 1)]
    second = np.concatenate([part[part > 0] for part in parts])
    return MEDIAN_TO_SIGMA * float(np.median(second)) if len(second) else 0.0


def _between(inverse: Floats, least: Floats) -> Mask:
    """Flying pixels along rows: a run of steep steps one way, its ends alone."""
    step = np.diff(inverse, axis=1)
    steep = np.abs(step) > np.fmax(least[:, 1:], least[:, :-1])
    found = np.zeros(inverse.shape, dtype=bool)
    row, first = np.nonzero(steep[:, 1:-2])  # the first step of a run; it has one before it
    first += 1
    alone = ALONE * np.abs(step[row, first - 1]) < np.abs(step[row, first])
    row, first = row[alone], first[alone]
    for width in range(1, WIDEST_PX + 1):
        inside = first + width < step.shape[1] - 1  # the last step has one after it
        row, first = row[inside], first[inside]
        last = first + width
        along = steep[row, last] & (step[row, last] * step[row, first] > 0)
        row, first, last = row[along], first[along], last[along]
        alone = ALONE * np.abs(step[row, last + 1]) < np.abs(step[row, last])
        for k in range(1, width + 1):
            found[row[alone], first[alone] + k] = True
    return found
