"""Series of shapes: angular to round, oblong to round, both at once; and a chart of all."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from synth.arrays import Floats
from synth.errors import SpecError
from synth.shapes.outline import RoundedPolygon
from synth.shapes.roughness import Roughness
from synth.shapes.rounded_polygons import rounded_polygons
from synth.shapes.shape import LONG_SIDE_PX, Shape, turn
from synth.spec.shapes import CHART, SERIES_NAMES
from synth.spec.wording import expected_one_of

_ROUNDNESS = (0.03, 0.75)  # ends of the series `roundness`
_RECTANGLE_RATIO = 0.78  # of the series `roundness`
_BOTH_SIDES = (0.35, 0.95)  # short over long side, ends of the series `both`
_SIDES = (0.18, 0.96)  # short over long side, ends of the series `sphericity`
_CORNER_ROUNDNESS = 0.6  # of the series `sphericity`
_WAVES = 0.03  # RMS of the series `rough`, over √(A/π)
_HEIGHTS = (0.002, 0.03)  # ends of the series `rippled`
_RIPPLED_ROUNDNESS = 0.3
_DEPTHS = (0.3, 0.0)  # ends of the series `jagged`
_JAGGED_ROUNDNESS = 0.7
_MAX_SHAPES = 100
_CLASSES = np.arange(1, 10) / 10.0  # of roundness, the chart's rows
_CHART_SIDES = np.linspace(0.30, 0.94, 9)  # short over long side, the chart's columns


@dataclass(frozen=True)
class Series:
    """Series: how its shapes are made from the values of its parameter."""

    make: Callable[[Floats, np.random.Generator], list[Shape]]
    ends: tuple[float, float]  # of the knob, when it rises in even steps
    limits: tuple[float, float]  # of values given one by one


def shape_series(
    series: str,
    *,
    count: int | None = None,
    knobs: Sequence[float] | None = None,
    rng: np.random.Generator,
) -> list[Shape]:
    """Shapes of a series in order: most angular, or most oblong, first.

    The knob rises in `count` even steps (4 by default), or takes the values `knobs`. The chart
    `krumbein` has 81 shapes, always.

    Raises:
        SpecError: an unknown series, a count out of range, values out of range, or both given.
    """
    if series == CHART:
        if knobs is not None or count not in (None, _CLASSES.size * _CHART_SIDES.size):
            option = "count" if knobs is None else "knobs"
            raise SpecError(f"{option}: expected none for the series {CHART}: always 81 shapes")
        return chart(rng)
    if series not in SERIES:
        raise SpecError(f"series: {expected_one_of(series, SERIES_NAMES)}")
    found = SERIES[series]
    if knobs is None:
        steps = 4 if count is None else count
        if not 1 <= steps <= _MAX_SHAPES:
            raise SpecError(f"count: expected 1 to {_MAX_SHAPES}, found {steps}")
        return found.make(np.linspace(*found.ends, steps), rng)
    if count not in (None, len(knobs)):
        raise SpecError(f"count: expected {len(knobs)} as knobs has, found {count}")
    low, high = found.limits
    for value in knobs:
        if not low <= value <= high:
            raise SpecError(f"knobs: expected {low:g} to {high:g} for {series}, found {value:g}")
    if not len(knobs):
        raise SpecError("knobs: expected at least one value, found none")
    return found.make(np.array(knobs, dtype=np.float64), rng)


def roundness_series(knobs: Floats, rng: np.random.Generator) -> list[Shape]:
    """Roundness series: one random polygon with ever rounder corners in the same rectangle.

    The knob is roundness. The polygon is stretched along the rectangle's sides so that the
    rounded shape fills it: sides of a sum are sums of sides.
    """
    return rounded_polygons(knobs.tolist(), [_RECTANGLE_RATIO] * len(knobs), rng)


def rough_series(knobs: Floats, rng: np.random.Generator) -> list[Shape]:
    """Roundness series under waves of five lengths: the knob is the smooth outline's roundness."""
    waves = Roughness("waves", _WAVES)
    return [replace(shape, roughness=waves) for shape in roundness_series(knobs, rng)]


def rippled_series(knobs: Floats, rng: np.random.Generator) -> list[Shape]:
    """Rippled series: one outline of one roundness under waves of five lengths, ever higher.

    The knob is the waves' RMS height over √(A/π).
    """
    smooth = rounded_polygons([_RIPPLED_ROUNDNESS], [_RECTANGLE_RATIO], rng)[0]
    return [
        replace(smooth, knob=float(height), roughness=Roughness("waves", float(height)))
        for height in knobs
    ]


def jagged_series(knobs: Floats, rng: np.random.Generator) -> list[Shape]:
    """Jagged series: one outline of one roundness under teeth ever less deep, the first deepest.

    The knob is the teeth's mean depth over √(A/π); at 0 the outline is smooth. The deepest have
    the angularity of the paper's figure 8.
    """
    smooth = rounded_polygons([_JAGGED_ROUNDNESS], [_RECTANGLE_RATIO], rng)[0]
    return [
        replace(smooth, knob=float(depth), roughness=Roughness("teeth", float(depth)))
        for depth in knobs
    ]


def both_series(knobs: Floats, rng: np.random.Generator) -> list[Shape]:
    """Series of both: one random polygon, angular and oblong at first, round and square at last.

    The knob is roundness; short over long side rises with it, in proportion.
    """
    return rounded_polygons(knobs.tolist(), np.interp(knobs, _ROUNDNESS, _BOTH_SIDES).tolist(), rng)


def chart(rng: np.random.Generator) -> list[Shape]:
    """Chart of 81 random shapes, row by row: roundness 0.1 to 0.9, oblong to square in each row.

    In the manner of Krumbein's (1941) chart of pebbles by roundness, but drawn anew, every
    outline of its own polygon, and every roundness and side known exactly.
    """
    return [
        rounded_polygons([float(roundness)], [float(ratio)], rng)[0]
        for roundness in _CLASSES
        for ratio in _CHART_SIDES
    ]


def sphericity_series(knobs: Floats, rng: np.random.Generator) -> list[Shape]:
    """Sphericity series: rounded rectangles from oblong to square, of one roundness, turned a bit.

    The largest disc in a rectangle of half sides l ≥ w rounded by r has the radius w + r, so
    r = ρ (w + r) gives the roundness ρ at any length.
    """
    shapes = []
    for ratio in knobs:
        long_px = LONG_SIDE_PX * min(1.0, 0.7 / np.sqrt(ratio))
        half_long, half_short = long_px / 2.0, long_px * ratio / 2.0
        radius = _CORNER_ROUNDNESS * half_short
        x, y = half_long - radius, half_short - radius
        corners = np.array([[-x, -y], [x, -y], [x, y], [-x, y]])
        turned = corners @ turn(rng.uniform(-0.06, 0.06)).T
        outline = RoundedPolygon(corners_px=turned, radius_px=float(radius))
        sides = (float(2.0 * half_long), float(2.0 * half_short))
        shapes.append(Shape(outline=outline, knob=float(ratio), sides_px=sides))
    return shapes


SERIES: Mapping[str, Series] = {
    "roundness": Series(roundness_series, ends=_ROUNDNESS, limits=(0.01, 0.95)),
    "sphericity": Series(sphericity_series, ends=_SIDES, limits=(0.05, 1.0)),
    "both": Series(both_series, ends=_ROUNDNESS, limits=(0.01, 0.95)),
    "rough": Series(rough_series, ends=_ROUNDNESS, limits=(0.01, 0.95)),
    "rippled": Series(rippled_series, ends=_HEIGHTS, limits=(0.0, 0.05)),
    "jagged": Series(jagged_series, ends=_DEPTHS, limits=(0.0, 0.35)),
}
