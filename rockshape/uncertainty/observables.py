"""Observables of a rock that its values' errors depend on: size, noise, form, what is hidden."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rockshape.numerics.arrays import Floats
from rockshape.rock.view import RockView

NAMES = (
    "one",
    "width",
    "width²",
    "noise",
    "noise²",
    "hidden",
    "departure",
    "no departure",
    "outline",
    "outline · width",
    "corners",
    "corners · width",
)
# columns of the measures that tell the form
DEPARTURE, OUTLINE, CORNERS = "ellipsoid_error", "ellipse_error", "angularity_2d"
_MIDDLE_PX = 64.0  # width about which its logarithm is taken
_LEAST_NOISE = 1e-3  # of the rock's width: below it range counts as exact
_MOST_DEPARTURE = 0.2
_MOST_OUTLINE, _COMMON_OUTLINE = 0.2, 0.05  # the common one where it is unknown
_MOST_CORNERS, _COMMON_CORNERS = 0.4, 0.15


@dataclass(frozen=True)
class Observables:
    """What is known of one rock in one view, before its errors."""

    width_px: float  # least Feret diameter
    noise: float  # standard deviation of the range over the rock's width; 0 exact or without range
    hidden: float  # share of its ellipse that is out of the frame or behind a nearer rock
    departure: float  # of the surface from its ellipsoid, over the rock's size; NaN where unknown
    outline: float = float("nan")  # departure of the outline from its ellipse, likewise
    corners: float = float("nan")  # 2-D angularity, likewise

    def features(self) -> Floats:
        """Features (12,) in the order of NAMES, each about 0 to 1 in size."""
        width = np.log2(max(self.width_px, 1.0) / _MIDDLE_PX) / 2.0
        noise = np.log10(max(self.noise, _LEAST_NOISE) / _LEAST_NOISE) / 2.0
        departure = _share(self.departure, _MOST_DEPARTURE, unknown=0.0)
        outline = _share(self.outline, _MOST_OUTLINE, unknown=_COMMON_OUTLINE)
        corners = _share(self.corners, _MOST_CORNERS, unknown=_COMMON_CORNERS)
        seen = [1.0, width, width**2, noise, noise**2, self.hidden]
        surface = [departure, float(np.isnan(self.departure))]
        return np.array([*seen, *surface, outline, outline * width, corners, corners * width])


def observe(view: RockView, values: Mapping[str, float], *, visible_fraction: float) -> Observables:
    """Observables of a rock.

    visible_fraction is of its ellipse; values are those of its measures by column, NaN or left out
    where there are none.
    """
    width_px = view.feret_px[0] if view.resolved else 1.0
    hidden = 1.0 if np.isnan(visible_fraction) else float(np.clip(1 - visible_fraction, 0, 1))
    departure, outline, corners = (
        values.get(name, float("nan")) for name in (DEPARTURE, OUTLINE, CORNERS)
    )
    noise = _noise(view, width_px)
    return Observables(float(width_px), noise, hidden, departure, outline, corners)


def _share(value: float, most: float, *, unknown: float) -> float:
    """Share of a value in the most that is told apart."""
    return min(unknown if np.isnan(value) else value, most) / most


def _noise(view: RockView, width_px: float) -> float:
    """Standard deviation of the range at the rock over its width; 0 where range is exact."""
    if view.noise is None or view.camera is None or len(view.points_m) == 0:
        return 0.0
    depth_m = np.median(view.points_m[:, 2:], axis=0)
    sd_m = float(view.noise.depth_sd_m(depth_m)[0])
    return sd_m / max(float(depth_m[0]) * width_px / view.camera.fx, 1e-12)
