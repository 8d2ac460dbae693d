"""Colour of light and surfaces: linear RGB with the primaries of sRGB, and its luminance."""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats, Singles

LUMINANCE: Floats = np.array([0.2126, 0.7152, 0.0722])
"""Weights (3,) of red, green and blue in luminance (ITU-R BT.709)."""


@dataclass(frozen=True, eq=False)
class Appearance:
    """Colours of a scene's light, ground and dust, each (3,) of luminance 1."""

    sun: Floats
    sky: Floats
    ground: Floats
    dust: Floats
    wetness: float = 0.0  # 0 dry … 1 under a film of water


def tint(rgb: tuple[float, float, float] | Floats) -> Floats:
    """Colour (3,) scaled to the luminance 1: what multiplies an albedo."""
    colour = np.asarray(rgb, dtype=np.float64)
    return np.asarray(colour / (colour @ LUMINANCE))


def luminance(light: Singles) -> Singles:
    """Luminance (...) of linear light of one or three channels, (..., k)."""
    return light[..., 0] if light.shape[-1] == 1 else light @ LUMINANCE.astype(np.float32)
