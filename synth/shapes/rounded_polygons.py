"""Random polygons rounded to stated roundness in rectangles of stated sides."""

from collections.abc import Sequence

import numpy as np

from synth.arrays import Floats
from synth.errors import SpecError
from synth.shapes.outline import RoundedPolygon, largest_disc_px, rectangle
from synth.shapes.shape import LONG_SIDE_PX, Shape, turn

_CORNERS = 7
_STEPS = 400
_ATTEMPTS = 100  # polygons drawn before the values count as impossible
_TOLERANCE = 1e-9


def rounded_polygons(
    roundness: Sequence[float], ratios: Sequence[float], rng: np.random.Generator
) -> list[Shape]:
    """One random polygon in all those roundnesses and ratios, drawn anew until all settle.

    Raises:
        SpecError: no polygon of many settles.
    """
    for _ in range(_ATTEMPTS):
        polygon = _random_polygon(rng)
        shapes = [_held(polygon, *pair) for pair in zip(roundness, ratios, strict=True)]
        settled = [shape for shape in shapes if shape is not None]
        if len(settled) == len(shapes):
            return settled
    raise SpecError(f"knobs: expected values that one polygon can take, found {list(roundness)}")


def _held(polygon: Floats, roundness: float, ratio: float) -> Shape | None:
    """Polygon rounded to a roundness inside a rectangle of a ratio.

    Each step turns the polygon into its rectangle and stretches it by the side wanted over the
    side found. The inscribed disc, and with it the rounding, goes with the short side; along the
    long side a power makes up for the rounding's share. None where two rectangles are so nearly
    the smallest that the steps never settle on one.
    """
    target = 0.85 * LONG_SIDE_PX * np.array([1.0, ratio])
    factor = roundness / (1.0 - roundness)
    corners = polygon
    for _ in range(_STEPS):
        radius = factor * largest_disc_px(corners)
        long, short, bearing = rectangle(corners, margin=radius)
        stretch = target / np.array([long, short])
        if np.abs(stretch - 1.0).max() < _TOLERANCE:
            outline = RoundedPolygon(corners_px=corners, radius_px=radius)
            return Shape(outline=outline, knob=roundness, sides_px=(long, short))
        stretch **= np.array([long / (long - 2.0 * radius), 1.0])
        corners = corners @ turn(-bearing).T * np.clip(stretch, 0.5, 2.0)
    return None


def _random_polygon(rng: np.random.Generator) -> Floats:
    """Convex polygon whose corners lie unevenly round an ellipse."""
    gaps = rng.uniform(0.55, 1.45, size=_CORNERS)
    bearing_rad = rng.uniform(0.0, 2.0 * np.pi) + 2.0 * np.pi * np.cumsum(gaps) / gaps.sum()
    return 0.5 * LONG_SIDE_PX * np.column_stack([np.cos(bearing_rad), 0.75 * np.sin(bearing_rad)])
