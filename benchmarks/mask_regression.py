"""Regression of an outline's roundness on two dozen numbers of its mask: what pixels leave to tell.

A floor under what any reading of so few pixels could do; it is taught on drawings of other seeds.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from silhouettes import Floats, Mask

from rockshape.measures import ellipse_error
from rockshape.measures.angularity_2d import angularity_beyond_form
from rockshape.outline.descriptors import describe
from rockshape.outline.edge import trace_edge
from rockshape.outline.form import FORM_SHARE, form_of
from rockshape.outline.roundness import bend_share
from rockshape.outline.trace import signed_area
from rockshape.rock.view import RockView

SIGMAS_PX = (1.2, 1.5, 1.8, 2.2, 2.7, 3.3, 4.0)
HARMONICS = (2, 3, 4, 5, 6, -2, -3, -4, -5, -6, -7)
REACH = 1.5  # of the kernel: root mean square distance of the numbers, in their deviations
STIFFNESS = 0.1


@dataclass(frozen=True, eq=False)
class MaskRegression:
    """Kernel ridge regression, taught."""

    middle: Floats  # (features,)
    spread: Floats  # (features,)
    places: Floats  # (n, features)
    weights: Floats  # (n,)
    level: float

    @classmethod
    def taught(cls, masks: Sequence[Mask], values: Sequence[float]) -> "MaskRegression":
        """Regression of values (n,) on masks."""
        found, wanted = np.array([features(mask) for mask in masks]), np.array(values)
        middle, spread = found.mean(axis=0), found.std(axis=0)
        places, level = (found - middle) / spread, float(wanted.mean())
        ridge = _kernel(places, places) + STIFFNESS * np.eye(len(places))
        return cls(middle, spread, places, np.linalg.solve(ridge, wanted - level), level)

    def __call__(self, mask: Mask) -> float:
        """Value of a mask."""
        place = (features(mask) - self.middle) / self.spread
        return float(_kernel(place[None], self.places)[0] @ self.weights) + self.level


def features(mask: Mask) -> Floats:
    """Numbers (24,) of a mask: size, bends at seven scales, angularity, harmonics, solidity."""
    edge = trace_edge(mask)
    radius = float(np.sqrt(abs(signed_area(edge)) / np.pi))
    shares = [max(FORM_SHARE, sigma / radius) for sigma in SIGMAS_PX]
    forms = [form_of(edge, staircase=True, share=share) for share in shares]
    form = form_of(edge, staircase=True)
    if form is None or None in forms:
        raise ValueError("mask: expected pixels with an area, found none")
    waves = np.abs(np.fft.fft(form.points[:, 0] + 1j * form.points[:, 1]))
    waves = np.log(waves / max(waves[1], waves[-1]) + 1e-4)
    numbers = describe(mask)
    return np.array(
        [
            1 / radius,
            *(bend_share(one) for one in forms if one is not None),
            angularity_beyond_form(form),
            min(waves[1], waves[-1]),
            *(waves[k] for k in HARMONICS),
            numbers.solidity,
            numbers.circularity,
            ellipse_error.ROBUST.read(RockView(mask=mask)).value,
        ]
    )


def _kernel(one: Floats, other: Floats) -> Floats:
    apart = ((one[:, None] - other) ** 2).sum(axis=-1) / one.shape[1]
    return np.asarray(np.exp(-apart / (2 * REACH**2)))
