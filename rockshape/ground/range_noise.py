"""How far the heights of bare ground scatter: roughness everywhere, range noise with distance."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

BINS = 8
MIN_IN_BIN = 30
NORMAL_MEDIAN = 0.6745  # of |x| for the standard normal distribution
FINE_SHARE = 0.05  # of a pixel's size
PIXEL_SHARE = 0.25  # heights below this share of a pixel's size cannot be seen


@dataclass(frozen=True)
class Noise:
    """Standard deviation of the ground's height at a pixel: sqrt(rough^2 + (range x)^2 + ...).

    x = Z^2 |n . r| with the ray r = (X/Z, Y/Z, 1) turns an error of the inverse depth into one of
    the height above the plane of normal n. A stereo camera's error of the inverse depth is even
    over the frame, sigma_d/(f B), so that sigma_Z = Z^2 sigma_d/(f B). The third part is a quarter
    of a pixel's size on the ground: where range is exact no height below that means anything.
    """

    rough_m: float
    inverse_depth_per_m: float  # standard deviation of 1/Z
    pixel_rad: float  # a pixel's angle

    def depth_m(self, depth_m: NDArray[np.floating]) -> NDArray[np.floating]:
        """Standard deviation of a z-depth."""
        return self.inverse_depth_per_m * depth_m**2

    def is_fine(self, depth_m: float) -> bool:
        """Whether heights and z-depths there scatter by less than a twentieth of a pixel's size.

        Matching windows scatter by a quarter of it and more, and bleed over edges; what scatters by
        less has its edges where the rocks have them.
        """
        scatter_m = np.hypot(self.rough_m, self.inverse_depth_per_m * depth_m**2)
        return bool(scatter_m < FINE_SHARE * self.pixel_rad * depth_m)

    def height_m(
        self, depth_m: NDArray[np.floating], slant: NDArray[np.floating]
    ) -> NDArray[np.floating]:
        """Standard deviation of heights at z-depths, with slant = |n . r|; shapes as given."""
        moving = (self.inverse_depth_per_m * slant) ** 2 * depth_m**2
        return np.sqrt(
            self.rough_m**2 + depth_m**2 * (moving + (PIXEL_SHARE * self.pixel_rad) ** 2)
        )


def estimate_noise(
    height_m: NDArray[np.float64],
    depth_m: NDArray[np.float64],
    slant: NDArray[np.float64],
    *,
    pixel_rad: float,
) -> Noise:
    """Noise from the heights (n,) of points of which rocks make many too high and few too low.

    In each of eight bins of x = Z^2 |n . r| the scatter is that of the lower half, the median of
    -h over h < 0, divided by 0.6745; variance = rough^2 + range^2 x^2 is fitted to the bins by
    least squares with neither part below zero. Without enough points below zero both are 0.
    """
    lever = depth_m**2 * slant
    below = height_m < 0
    if below.sum() < MIN_IN_BIN:
        return Noise(0.0, 0.0, pixel_rad)
    deep, lever = -height_m[below], lever[below]
    edges = np.quantile(lever, np.linspace(0, 1, BINS + 1))
    place = np.clip(np.searchsorted(edges, lever, side="right") - 1, 0, BINS - 1)
    variances, squares = [], []
    for number in range(BINS):
        own = place == number
        if own.sum() >= MIN_IN_BIN // 2:
            variances.append((np.median(deep[own]) / NORMAL_MEDIAN) ** 2)
            squares.append(float(np.mean(lever[own] ** 2)))
    variance, square = np.array(variances), np.array(squares)
    # relative errors of the bins are alike, so each is weighed by its own size
    weight = 1.0 / np.maximum(variance, 1e-12)
    rows = np.column_stack([np.ones(len(square)), square]) * weight[:, None]
    scale = np.maximum(np.abs(rows).max(axis=0), 1e-300)
    parts, _ = nnls(rows / scale, variance * weight)
    rough, moving = np.sqrt(parts / scale)
    return Noise(float(rough), float(moving), pixel_rad)
