"""Noise model of a measured frame: range errors, their correlation, the ground's roughness."""

from dataclasses import dataclass
from typing import TypeVar

import cv2
import numpy as np
from numpy.typing import NDArray

Real = TypeVar("Real", bound=np.floating)

FINE_SHARE = 0.05  # of a pixel's size
PIXEL_SHARE = 0.25  # heights below this share of a pixel's size cannot be seen


@dataclass(frozen=True)
class NoiseModel:
    """Normal errors of inverse depth, correlated over a window of the image, on rough ground.

    A stereo camera's error of the inverse depth 1/Z has one standard deviation over the frame,
    sigma_d/(f B) for the disparity's sigma_d, so that sigma_Z = Z² sigma_d/(f B). The correlation
    of two pixels' errors falls linearly with their distance and is 0 from the window's side on, in
    rows and in columns, as errors of a block matcher do.
    """

    inverse_depth_sd_per_m: float  # standard deviation of 1/Z
    window_px: int  # side of the correlation window, odd
    rough_m: float  # standard deviation of the ground's own heights about its fitted surface
    pixel_rad: float  # a pixel's angle

    def depth_sd_m(self, depth_m: NDArray[Real]) -> NDArray[Real]:
        """Standard deviation of z-depths of any shape."""
        return np.asarray(self.inverse_depth_sd_per_m * depth_m**2, dtype=depth_m.dtype)

    def height_sd_m(
        self, depth_m: NDArray[np.floating], slant: NDArray[np.floating]
    ) -> NDArray[np.floating]:
        """Standard deviation of the bare ground's measured heights; shapes as given.

        sqrt(rough² + (sigma_Z |n·r|)² + (a quarter of a pixel's size)²), with slant = |n·r| of the
        ray r = (X/Z, Y/Z, 1) and the ground's normal n. Where range is exact, no height below a
        quarter of a pixel means anything.
        """
        moving = (self.inverse_depth_sd_per_m * slant) ** 2 * depth_m**2
        return np.sqrt(
            self.rough_m**2 + depth_m**2 * (moving + (PIXEL_SHARE * self.pixel_rad) ** 2)
        )

    def mean_variance(self, side_px: int) -> float:
        """Variance of the mean error over a square of the image, over that of one error.

        Each way the mean of 1 - |i - j|/window, 0 from the window on, over pairs of places i and j.
        """
        apart = np.abs(np.subtract.outer(np.arange(side_px), np.arange(side_px)))
        return float(np.maximum(0, 1 - apart / self.window_px).mean() ** 2)

    def is_fine(self, depth_m: float) -> bool:
        """Whether z-depths there have errors below a twentieth of a pixel's size.

        A block matcher's errors are a quarter of it and more, and it bleeds over edges; range with
        less has its edges where the rocks have them.
        """
        return self.inverse_depth_sd_per_m * depth_m < FINE_SHARE * self.pixel_rad

    def draw_m(
        self, depth_m: NDArray[np.float64], *, rng: np.random.Generator
    ) -> NDArray[np.float64]:
        """One draw of errors of z-depth for a window of the image, depth_m (rows, cols)."""
        white = rng.standard_normal(depth_m.shape)
        side = (self.window_px, self.window_px)
        even = cv2.boxFilter(white, -1, side, normalize=False, borderType=cv2.BORDER_REFLECT)
        return np.asarray(self.depth_sd_m(depth_m) * even / self.window_px)
