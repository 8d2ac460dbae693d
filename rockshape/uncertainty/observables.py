"""Observables of a rock that its values' errors depend on: size, noise and what is hidden."""

from dataclasses import dataclass

import numpy as np

from rockshape.numerics.arrays import Floats
from rockshape.rock.view import RockView

NAMES = ("one", "width", "noise", "hidden", "value")
_MIDDLE_PX = 64.0  # width about which its logarithm is taken
_LEAST_NOISE = 1e-3  # of the rock's width: below it range counts as exact
_LITTLE = 0.01  # hidden share about which its effect turns from its own to its logarithm's


@dataclass(frozen=True)
class Observables:
    """What is known of one rock in one view, before its errors."""

    width_px: float  # least Feret diameter
    noise: float  # standard deviation of the range over the rock's width; 0 exact or without range
    hidden: float  # share of its ellipse that may be hidden
    found: bool = False  # a finder drew its outline, which may be wrong

    def features(self, level: float) -> Floats:
        """Features (5,) in the order of NAMES for a value's error; level is of the value."""
        width = np.log2(max(self.width_px, 1.0) / _MIDDLE_PX) / 2.0
        noise = np.log10(max(self.noise, _LEAST_NOISE) / _LEAST_NOISE) / 2.0
        hidden = np.log10(1.0 + self.hidden / _LITTLE)
        return np.array([1.0, width, noise, hidden, level])


def observe(view: RockView, *, visible_fraction: float, found: bool) -> Observables:
    """Observables of a rock.

    visible_fraction is the least share of its ellipse that is visible, found whether a finder has
    drawn its outline.
    """
    width_px = view.feret_px[0] if view.resolved else 1.0
    hidden = 1.0 if np.isnan(visible_fraction) else float(np.clip(1 - visible_fraction, 0, 1))
    return Observables(float(width_px), _noise(view, width_px), hidden, found)


def _noise(view: RockView, width_px: float) -> float:
    """Standard deviation of the range at the rock over its width; 0 where range is exact."""
    if view.noise is None or view.camera is None or len(view.points_m) == 0:
        return 0.0
    depth_m = np.median(view.points_m[:, 2:], axis=0)
    sd_m = float(view.noise.depth_sd_m(depth_m)[0])
    return sd_m / max(float(depth_m[0]) * width_px / view.camera.fx, 1e-12)
