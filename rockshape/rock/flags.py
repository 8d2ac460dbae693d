"""Flags of a rock: what weakens the values that it has."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from rockshape.body import greatest_width_m
from rockshape.rock.view import RockView

MIN_ROUNDNESS_PX = 30.0  # width from which roundness is read at one share of a rock's size
SOFT_SHARE = 0.25  # of the scale at which the outline's form is read, that its error may be
SEEN_SHARE = 0.8  # of the longest axis, that the visible surface must span
VISIBLE_SHARE = 0.9  # of the fitted ellipse
SOFT_OUTLINE = "soft outline"


@dataclass(frozen=True)
class KnownOfRock:
    """What is known of a rock beside its view."""

    visible_fraction: float  # of its ellipse; NaN where there is none
    outline_sd_px: float  # standard deviation of its outline; NaN where it is not known
    is_drawn: bool  # whether a picture alone has drawn its outline
    values: Mapping[str, float]  # of the measures by their columns, NaN where there is none


def view_flags(view: RockView, known: KnownOfRock) -> tuple[str, ...]:
    """Flags of a rock by its view, whoever outlined it.

    `truncated`: touches the border of the frame. `small for roundness`: its roundness is read from
    less than 30 px of width. `soft outline`: its outline is unsure by more than a quarter of the
    scale at which its form is read, or a picture alone has drawn it. `extrapolated axis`: its
    visible surface spans less than 0.8 of its longest axis, the rest is inferred. `hidden`: less
    than 0.9 of its fitted ellipse is seen. `edges by shading`: range alone is too noisy
    for its angularity in three dimensions, which the picture tells.
    """
    return tuple(_flags(view, known))


def _flags(view: RockView, known: KnownOfRock) -> Iterator[str]:
    if view.truncated:
        yield "truncated"
    rounded = np.isfinite(known.values.get("roundness", np.nan))
    if rounded and view.feret_px[0] < MIN_ROUNDNESS_PX:
        yield "small for roundness"
    if _soft(view, known):
        yield SOFT_OUTLINE
    if _extrapolated(view):
        yield "extrapolated axis"
    if known.visible_fraction < VISIBLE_SHARE:
        yield "hidden"
    if np.isfinite(known.values.get("angularity_3d", np.nan)) and _by_shading(view):
        yield "edges by shading"


def _by_shading(view: RockView) -> bool:
    """Whether what tells edges is not range."""
    return view.relief is not None and not view.relief.resolves_edges


def _soft(view: RockView, known: KnownOfRock) -> bool:
    """Whether the outline is less sure than its form is read."""
    if view.form is None:
        return False
    return known.is_drawn or known.outline_sd_px > SOFT_SHARE * view.form.sigma


def _extrapolated(view: RockView) -> bool:
    """Whether the longest axis reaches far beyond what is seen of the rock."""
    if view.body_half_axes_m is None:
        return False
    return greatest_width_m(view.visible_m) < SEEN_SHARE * 2 * float(view.body_half_axes_m[0])
