"""Roughness laid on drawn outlines: waves of several lengths, or sharp teeth."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from synth.arrays import Floats

WAVELENGTHS = (2.0, 1.0, 0.5, 0.25, 0.125)  # of the bands, over the radius √(A/π)
_FALL = 0.8  # a band's height goes as its wavelength to this power
_TOOTH = 8  # steps of a tooth: 4 px
_UNEVEN = 0.3  # share by which teeth are deeper or shallower


@dataclass(frozen=True)
class Roughness:
    """Roughness: `waves` stand on either side of the outline, `teeth` are cut into it."""

    kind: Literal["waves", "teeth"]
    height: float  # RMS of waves, mean depth of teeth, over the radius √(A/π) of the outline's area


@dataclass(frozen=True, eq=False)
class RoughOutline:
    """Rough outline, and the heights that were laid on the smooth one."""

    points_px: Floats  # (n, 2)
    rms_px: float  # of the heights along the smooth outline
    wavelengths_px: tuple[float, float]  # shortest and longest


def rough_outline(
    smooth_px: Floats, radius_px: float, roughness: Roughness, rng: np.random.Generator
) -> RoughOutline:
    """Rough outline from points (n, 2) half a pixel apart on a smooth convex one.

    Heights are laid along the rays from the points' mean, so that the line never crosses itself.
    `radius_px` is √(A/π) of the smooth outline.
    """
    if roughness.kind == "waves":
        heights_px, wavelengths_px = _waves(len(smooth_px), radius_px, rng)
        heights_px *= roughness.height * radius_px
    else:
        heights_px = _teeth(len(smooth_px), rng) * roughness.height * radius_px
        wavelengths_px = (_TOOTH / 2.0, _TOOTH / 2.0)
    middle_px = smooth_px.mean(axis=0)
    arms_px = smooth_px - middle_px
    share = heights_px / np.linalg.norm(arms_px, axis=1)
    return RoughOutline(
        points_px=middle_px + arms_px * (1.0 + share[:, None]),
        rms_px=float(np.sqrt(np.mean(heights_px**2))),
        wavelengths_px=wavelengths_px,
    )


def _waves(
    count: int, radius_px: float, rng: np.random.Generator
) -> tuple[Floats, tuple[float, float]]:
    """Heights (count,) of RMS 1, and the shortest and longest wavelength in them.

    Each band holds the harmonics within half an octave of its wavelength on either side. Bands
    shorter than four pixels, which no picture could show, are left out.
    """
    length_px = 0.5 * count
    turn = 2.0 * np.pi * np.arange(count) / count
    heights = np.zeros(count)
    harmonics: set[int] = set()
    for wavelength in WAVELENGTHS:
        middle = length_px / (wavelength * radius_px)
        low, high = int(np.ceil(middle / np.sqrt(2.0))), int(middle * np.sqrt(2.0))
        if length_px / high < 4.0:
            continue
        band = np.zeros(count)
        for harmonic in range(low, high + 1):
            cosine, sine = rng.standard_normal(2)
            band += cosine * np.cos(harmonic * turn) + sine * np.sin(harmonic * turn)
        heights += wavelength**_FALL * band / np.sqrt(np.mean(band**2))
        harmonics.update(range(low, high + 1))
    heights /= np.sqrt(np.mean(heights**2))
    return heights, (length_px / max(harmonics), length_px / min(harmonics))


def _teeth(count: int, rng: np.random.Generator) -> Floats:
    """Depths (count,), negative, of teeth 4 px wide whose mean depth is about 1."""
    ramp = np.abs(np.arange(_TOOTH) - _TOOTH / 2.0) / (_TOOTH / 2.0) - 1.0
    teeth = count // _TOOTH
    depths = rng.uniform(1.0 - _UNEVEN, 1.0 + _UNEVEN, size=teeth)
    heights = np.zeros(count)
    heights[: teeth * _TOOTH] = (depths[:, None] * ramp).ravel()
    return heights
