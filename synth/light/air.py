"""Air: the sky behind a scene, and the veil that air lays over what is far."""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Singles
from synth.light.photometry import EXPOSURE, SKY

_DUSTY_HORIZON = 1.25  # brightness of a dusty sky there, over that of an even one
_DUSTY_ABOVE = 0.9  # likewise, far above it
_BAND = 0.2  # sine of the elevation over which the brighter band fades


@dataclass(frozen=True, eq=False)
class Air:
    """Air under a sky of a colour (k,): clear, or dusty where a distance veils 63 %.

    A clear sky has one brightness. A dusty one is about as bright as an even sky must be to give
    level ground its share of the light, E × `ambient`, a little more near the horizon.
    """

    colour: Singles  # (k,)
    ambient: float  # share of the sky in the light on level ground
    haze_m: float | None = None

    def sky(self, rays: Singles) -> Singles:
        """Light (n, k) of the sky along rays (n, 3)."""
        if self.haze_m is None:
            return np.full(len(rays), np.float32(SKY))[:, None] * self.colour
        sines = rays[:, 2] / np.linalg.norm(rays, axis=1)
        band = np.exp(-((np.maximum(sines, 0.0) / _BAND) ** 2))
        bright = _DUSTY_ABOVE + (_DUSTY_HORIZON - _DUSTY_ABOVE) * band
        return np.asarray((EXPOSURE * self.ambient * bright)[:, None] * self.colour, np.float32)

    def veiled(self, light: Singles, distance_m: Singles) -> Singles:
        """Light (n, k) that comes through the air from distances (n,).

        Air adds what it takes, in the colour of the horizon: L e^(−d/h) + A (1 − e^(−d/h)).
        """
        if self.haze_m is None:
            return light
        clear = np.exp(-distance_m / np.float32(self.haze_m))[:, None]
        air = np.float32(EXPOSURE * self.ambient * _DUSTY_HORIZON) * self.colour
        return np.asarray(air + clear * (light - air))
