"""Two series of shapes: angular to round in one frame, and oblong to round at one roundness."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.errors import InputError
from synth.shapes.outline import RoundedPolygon, largest_disc_px, rectangle

Floats = NDArray[np.float64]

LONG_SIDE_PX = 200.0
_ROUNDNESS = (0.03, 0.75)  # ends of the series `roundness`
_RECTANGLE_RATIO = 0.78  # of the series `roundness`
_SIDES = (0.18, 0.96)  # short over long side, ends of the series `sphericity`
_CORNER_ROUNDNESS = 0.6  # of the series `sphericity`
_CORNERS = 7
_STEPS = 200
_TOLERANCE = 1e-9


@dataclass(frozen=True, eq=False)
class Shape:
    """One shape of a series."""

    outline: RoundedPolygon
    knob: float  # the series' own: roundness, or short over long side
    sides_px: tuple[float, float]  # long and short side of the smallest rectangle


def shape_series(series: str, *, count: int, rng: np.random.Generator) -> list[Shape]:
    """Return the shapes of a series in order: most angular, or most oblong, first.

    Raises:
        InputError: an unknown series, or a count below 1.
    """
    if series not in SERIES:
        raise InputError(f"--series: expected one of {', '.join(SERIES)}, found {series!r}")
    if count < 1:
        raise InputError(f"--count: expected at least 1, found {count}")
    return SERIES[series](count, rng)


def roundness_series(count: int, rng: np.random.Generator) -> list[Shape]:
    """Return one random polygon with ever rounder corners in ever the same rectangle.

    Roundness rises in equal steps. The polygon is stretched along the rectangle's sides so that
    the rounded shape fills it: sides of a sum are sums of sides.
    """
    polygon = _random_polygon(rng)
    return [_held(polygon, float(value)) for value in np.linspace(*_ROUNDNESS, count)]


def sphericity_series(count: int, rng: np.random.Generator) -> list[Shape]:
    """Return rounded rectangles from oblong to square, all of the same roundness, a little turned.

    The largest disc in a rectangle of half sides l ≥ w rounded by r has the radius w + r, so
    r = ρ (w + r) gives the roundness ρ at any length.
    """
    shapes = []
    for ratio in np.linspace(*_SIDES, count):
        long_px = LONG_SIDE_PX * min(1.0, 0.7 / np.sqrt(ratio))
        half_long, half_short = long_px / 2.0, long_px * ratio / 2.0
        radius = _CORNER_ROUNDNESS * half_short
        x, y = half_long - radius, half_short - radius
        corners = np.array([[-x, -y], [x, -y], [x, y], [-x, y]])
        turned = corners @ _turn(rng.uniform(-0.06, 0.06)).T
        outline = RoundedPolygon(corners_px=turned, radius_px=float(radius))
        sides = (float(2.0 * half_long), float(2.0 * half_short))
        shapes.append(Shape(outline=outline, knob=float(ratio), sides_px=sides))
    return shapes


SERIES: Mapping[str, Callable[[int, np.random.Generator], list[Shape]]] = {
    "roundness": roundness_series,
    "sphericity": sphericity_series,
}


def _held(polygon: Floats, roundness: float) -> Shape:
    """Return the polygon rounded to a roundness inside the series' rectangle.

    Each step turns the polygon into its rectangle and stretches it by the side wanted over the
    side found. The inscribed disc, and with it the rounding, goes with the short side; along the
    long side a power makes up for the rounding's share.
    """
    target = 0.85 * LONG_SIDE_PX * np.array([1.0, _RECTANGLE_RATIO])
    factor = roundness / (1.0 - roundness)
    corners = polygon
    for _ in range(_STEPS):
        radius = factor * largest_disc_px(corners)
        long, short, bearing = rectangle(corners)
        core = np.array([long, short])
        power = np.array([(long + 2.0 * radius) / long, 1.0])
        stretch = (target / (core + 2.0 * radius)) ** power
        corners = corners @ _turn(-bearing).T * np.clip(stretch, 0.5, 2.0)
        if np.abs(stretch - 1.0).max() < _TOLERANCE:
            break
    radius = factor * largest_disc_px(corners)
    long, short, _ = rectangle(corners)
    return Shape(
        outline=RoundedPolygon(corners_px=corners, radius_px=radius),
        knob=roundness,
        sides_px=(long + 2.0 * radius, short + 2.0 * radius),
    )


def _random_polygon(rng: np.random.Generator) -> Floats:
    """Return a convex polygon whose corners lie unevenly round an ellipse."""
    gaps = rng.uniform(0.55, 1.45, size=_CORNERS)
    bearing_rad = rng.uniform(0.0, 2.0 * np.pi) + 2.0 * np.pi * np.cumsum(gaps) / gaps.sum()
    return 0.5 * LONG_SIDE_PX * np.column_stack([np.cos(bearing_rad), 0.75 * np.sin(bearing_rad)])


def _turn(angle_rad: float) -> Floats:
    cosine, sine = np.cos(angle_rad), np.sin(angle_rad)
    return np.array([[cosine, -sine], [sine, cosine]])
