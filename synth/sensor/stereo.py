"""The error model of a stereo camera: what a matcher would measure, without matching."""

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.sensor.holes import contrast, half_occluded
from synth.sensor.rig import Rig
from synth.spec.sensor import NoiseSpec

Floats = NDArray[np.float64]


def modelled_depth_m(
    depth_m: Floats,
    light: NDArray[np.floating],
    rig: Rig,
    noise: NoiseSpec,
    *,
    rng: np.random.Generator,
) -> Floats:
    """Return the z-depth, (rows, cols), that a stereo camera measures; NaN in its holes.

    d = f B / Z + σ_d g, rounded to the matcher's steps, and Z = f B / d. g is normal noise of
    unit variance that is even over the matching window, so errors of neighbours are alike:
    σ_Z = Z² σ_d / (f B) (Kim et al. 2005). Holes are where one eye alone sees the surface and
    where the picture's contrast is below the least that can be matched.
    """
    exact_px = rig.disparity_px(depth_m)
    found_px = exact_px + noise.disparity_px * even_noise(depth_m.shape, noise.window_px, rng=rng)
    if noise.step_px > 0.0:
        found_px = noise.step_px * np.rint(found_px / noise.step_px)
    holes = half_occluded(exact_px) | (contrast(light, noise.window_px) < noise.min_texture)
    return np.where(holes, np.nan, rig.depth_m(found_px))


def even_noise(shape: tuple[int, ...], window_px: int, *, rng: np.random.Generator) -> Floats:
    """Return normal noise of unit variance, (rows, cols): white noise summed over a window.

    The sum of w² independent values has the variance w²; the correlation of two pixels falls
    linearly with their distance and is 0 from w on, in rows and in columns.
    """
    half = window_px // 2
    white = rng.standard_normal((shape[0] + 2 * half, shape[1] + 2 * half))
    total = cv2.boxFilter(white, -1, (window_px, window_px), normalize=False)
    return np.asarray(total[half : half + shape[0], half : half + shape[1]] / window_px)
