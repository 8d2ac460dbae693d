"""Estimators of range noise from the ground of a frame: the package's own and two simpler ones.

Each takes points (rows, cols, 3), the ground fitted to them and the true rocks (rows, cols), and
returns the standard deviation of the inverse depth, 1/m.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

from rockshape.ground import Ground

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

NORMAL_MEDIAN = 0.6745  # of |x| for the standard normal distribution
LAG_PX = 12
BINS = 8


def second_differences(_points_m: Floats, ground: Ground, _rocks: Mask) -> float:
    """Return the deviation of 1/Z by the noise model that the ground carries."""
    return 0.0 if ground.noise is None else ground.noise.inverse_depth_sd_per_m


def first_differences(points_m: Floats, ground: Ground, rocks: Mask) -> float:
    """Return the deviation of 1/Z by the median difference of pixels 12 apart on the plane."""
    depth = points_m[..., 2]
    height = ground.plane.height_m(points_m)
    with np.errstate(invalid="ignore", divide="ignore"):
        slant = points_m @ ground.plane.normal / depth
        error = height / slant / depth**2
    known = ~rocks & (slant < -0.1) & (np.abs(height) <= 4 * ground.plane.sigma_m)
    error = np.where(known, error, np.nan)
    apart = np.abs(error[:, LAG_PX:] - error[:, :-LAG_PX])
    return float(np.nanmedian(apart)) / NORMAL_MEDIAN / np.sqrt(2)


def lower_half(points_m: Floats, ground: Ground, _rocks: Mask) -> float:
    """Return the deviation of 1/Z by rough² + (k x)² fitted to the scatter below the ground."""
    points = points_m[2::4, 2::4].reshape(-1, 3)
    height = ground.height_m(points)
    lever = np.abs(points @ ground.plane.normal) * points[:, 2]
    below = height < 0
    deep, lever = -height[below], lever[below]
    edges = np.quantile(lever, np.linspace(0, 1, BINS + 1)[1:-1])
    place = np.searchsorted(edges, lever, side="right")
    bins = [place == one for one in range(BINS)]
    variance = np.array([(np.median(deep[own]) / NORMAL_MEDIAN) ** 2 for own in bins])
    square = np.array([np.mean(lever[own] ** 2) for own in bins])
    rows = np.column_stack([np.ones(BINS), square]) / variance[:, None]
    scale = rows.max(axis=0)
    parts, _ = nnls(rows / scale, np.ones(BINS))
    return float(np.sqrt(parts[1] / scale[1]))


Estimator = Callable[[Floats, Ground, Mask], float]
ESTIMATORS: dict[str, Estimator] = {
    "second differences": second_differences,
    "first differences, median": first_differences,
    "lower half of heights": lower_half,
}
