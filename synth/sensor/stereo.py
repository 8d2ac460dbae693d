"""Stereo error model: the range that a matcher would measure, without matching."""

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats
from synth.sensor.fattening import fattened_px
from synth.sensor.occlusion import contrast, half_occluded
from synth.sensor.rectify import Rectification, rectification_of
from synth.sensor.rig import Rig, rig_of
from synth.sensor.seeds import Use
from synth.sensor.sensor import Capture, Sensor, SensorInput
from synth.spec.sensor import NoiseSpec, fattening_px

_RIM_PX = 2  # the pull is the mean over a window this much smaller: its rim counts less


def modelled_depth_m(
    depth_m: Floats,
    light: NDArray[np.floating],
    rig: Rig,
    noise: NoiseSpec,
    *,
    rng: np.random.Generator,
    lens: Rectification | None = None,
) -> Floats:
    """Z-depth, (rows, cols), that a stereo camera measures; NaN in its holes.

    d = d₀ + σ_d √(1 + (c₀/c)²) g − A ⟨sin 2πd₀⟩ with d₀ = f B / Z, rounded to the matcher's
    steps; Z = f B / d. g is normal noise of unit variance that is even over the matching window,
    so errors of neighbours are alike: σ_Z = Z² σ_d / (f B) (Kim et al. 2005). c is the contrast of
    `light` as exposed: the part of the error that the pictures' noise makes goes as 1/c (Förstner
    1982). A is the pull towards whole disparities that a parabola through costs has (Shimizu and
    Okutomi 2001), a mean over the window's middle. Holes are where one eye alone sees the surface
    and where c is below the least that can be matched. Where windows bleed, all this is said of
    surfaces whose edges lie as far outside. `lens` is the straightening of the eyes' lens, if they
    have one.
    """
    exact_px = fattened_px(rig.disparity_px(depth_m), fattening_px(noise))
    texture = contrast(light, noise.window_px)
    sigma_px = noise.disparity_px * np.hypot(1.0, noise.weak_texture / np.maximum(texture, 1e-3))
    found_px = exact_px + sigma_px * even_noise(depth_m.shape, noise.window_px, rng=rng)
    found_px -= noise.locking_px * pull(exact_px, noise.window_px - _RIM_PX)
    if noise.step_px > 0.0:
        found_px = noise.step_px * np.rint(found_px / noise.step_px)
    holes = _hidden(exact_px, lens) | (texture < noise.min_texture)
    return np.where(holes, np.nan, rig.depth_m(found_px))


def _hidden(exact_px: Floats, lens: Rectification | None) -> NDArray[np.bool_]:
    """Pixels that one eye alone sees; under a lens, by the straightened images' rows."""
    if lens is None:
        return half_occluded(exact_px)
    straight_px = lens.straight_disparity_px(exact_px)
    return lens.bent_mask(half_occluded(straight_px) | lens.outside_right(straight_px))


def pull(disparity_px: Floats, window_px: int) -> Floats:
    """Window mean of sin 2πd, (rows, cols): the pull of sub-pixel interpolation.

    Where d runs through whole disparities within the window, the pulls cancel.
    """
    sines = np.nan_to_num(np.sin(2.0 * np.pi * disparity_px))
    return np.asarray(cv2.boxFilter(sines, -1, (window_px, window_px)))


def even_noise(shape: tuple[int, ...], window_px: int, *, rng: np.random.Generator) -> Floats:
    """Correlated normal noise of unit variance, (rows, cols): white noise summed over a window.

    The sum of w² independent values has the variance w²; the correlation of two pixels falls
    linearly with their distance and is 0 from w on, in rows and in columns.
    """
    half = window_px // 2
    white = rng.standard_normal((shape[0] + 2 * half, shape[1] + 2 * half))
    total = cv2.boxFilter(white, -1, (window_px, window_px), normalize=False)
    return np.asarray(total[half : half + shape[0], half : half + shape[1]] / window_px)


def stereo_depth_m(shot: SensorInput) -> Floats:
    """Z-depth of a view, (rows, cols), by the error model of its preset's stereo camera."""
    return modelled_depth_m(
        shot.view.depth_m,
        shot.exposed_light(),
        rig_of(shot.spec.camera.preset),
        shot.spec.noise,
        rng=shot.random(Use.DISPARITY),
        lens=None if shot.camera.distortion is None else rectification_of(shot.camera),
    )


def _capture(shot: SensorInput) -> Capture:
    return Capture(picture=shot.picture, depth_m=stereo_depth_m(shot))


STEREO = Sensor("stereo", "the error model of a stereo camera", _capture, needs_baseline=True)
