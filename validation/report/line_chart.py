"""Line charts as inline SVG: one score over the steps of a sweep, a line a method."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from markupsafe import Markup, escape

from validation.report.format import interval, number
from validation.report.svg_axes import Axis, grid_rows

WIDTH, HEIGHT = 300.0, 190.0
LEFT, RIGHT, TOP, BOTTOM = 40.0, 10.0, 12.0, 38.0
_INSET = 18.0  # of the first and last step
_APART = 5.0  # of two lines' marks at one step


@dataclass(frozen=True)
class Line:
    """A method's value with its interval at every step; NaN where there is none."""

    name: str
    style: int  # of its colour
    values: tuple[float, ...]
    lows: tuple[float, ...]
    highs: tuple[float, ...]


def _height(lines: Sequence[Line], most: float) -> Axis:
    """Vertical axis: all values and intervals, and 0 to `most` at least."""
    shown = np.array([v for line in lines for v in (*line.values, *line.lows, *line.highs)])
    shown = shown[np.isfinite(shown)]
    low, high = float(min([0.0, *shown])), float(max([most, *shown]))
    return Axis(low, high, log=False, start=HEIGHT - BOTTOM, end=TOP)


def line_chart(
    lines: Sequence[Line], *, steps: Sequence[str], x_title: str, title: str, most: float
) -> Markup:
    """SVG with the steps evenly along x; bars are the values' intervals.

    The vertical axis reaches from 0 to `most` at least.
    """
    height = _height(lines, most)
    across = np.linspace(LEFT + _INSET, WIDTH - RIGHT - _INSET, len(steps))
    parts = [
        f'<svg class="chart" viewBox="0 0 {WIDTH:.0f} {HEIGHT:.0f}" role="img" '
        f'aria-label="{escape(title)} over {escape(x_title)}">'
    ]
    parts.append(grid_rows(height, LEFT, WIDTH - RIGHT))
    parts += [
        f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 15}" class="mid">{escape(step)}</text>'
        for x, step in zip(across, steps, strict=True)
    ]
    for number_of_line, line in enumerate(lines):
        shift = _APART * (number_of_line - (len(lines) - 1) / 2)
        parts += _drawn(line, height, [float(x + shift) for x in across], steps)
    middle = (LEFT + WIDTH - RIGHT) / 2
    parts.append(f'<text x="{middle}" y="{HEIGHT - 6}" class="mid">{escape(x_title)}</text></svg>')
    return Markup("".join(parts))


def _drawn(
    line: Line, height: Axis, across: Sequence[float], steps: Sequence[str]
) -> Iterator[str]:
    """Line's path, then its bars and marks; a step without a value breaks the path."""
    path, pen = "", "M"
    for x, value in zip(across, line.values, strict=True):
        if not np.isfinite(value):
            pen = "M"
            continue
        path += f"{pen}{x:.1f} {height.place(value):.1f}"
        pen = "L"
    yield f'<path class="line l{line.style}" d="{path}"/>'
    for x, step, value, low, high in zip(
        across, steps, line.values, line.lows, line.highs, strict=True
    ):
        if not np.isfinite(value):
            continue
        if np.isfinite(low) and np.isfinite(high):
            yield (
                f'<path class="bar l{line.style}" d="M{x:.1f} {height.place(low):.1f}'
                f'V{height.place(high):.1f}"/>'
            )
        told = f"{line.name}, {step}: {number(value)}"
        if between := interval(low, high):
            told += f" ({between})"
        yield (
            f'<circle class="v{line.style}" cx="{x:.1f}" cy="{height.place(value):.1f}" r="3.2">'
            f"<title>{escape(told)}</title></circle>"
        )
