"""Charts as inline SVG, coloured by the page's style so that they follow light and dark."""

from dataclasses import dataclass

import numpy as np
from markupsafe import Markup, escape
from numpy.typing import NDArray

WIDTH, HEIGHT = 340.0, 250.0
LEFT, RIGHT, TOP, BOTTOM = 66.0, 12.0, 14.0, 40.0
VIEW_STYLES = 6  # colours and marks repeat after so many views
LOG_FROM = 20.0  # a measure whose values span more than this factor gets a logarithmic axis

WIDE = 300.0  # a logarithmic axis over more than this factor marks the decades alone


@dataclass(frozen=True, eq=False)
class Points:
    """What a chart shows: one point a rock and view."""

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    view: NDArray[np.intp]
    label: tuple[str, ...]


@dataclass(frozen=True)
class _Axis:
    low: float
    high: float
    log: bool
    start: float  # place of low in the picture
    end: float  # place of high

    def place(self, value: float) -> float:
        """Return the picture's coordinate of a value."""
        low, high, at = self.low, self.high, value
        if self.log:
            low, high, at = np.log10(low), np.log10(high), np.log10(value)
        return self.start + (self.end - self.start) * (at - low) / (high - low)

    def ticks(self) -> list[float]:
        """Return round values inside the axis."""
        if self.log:
            lowest, highest = np.floor(np.log10(self.low)), np.ceil(np.log10(self.high))
            decades = 10.0 ** np.arange(lowest, highest + 1)
            steps = (1.0,) if self.high / self.low > WIDE else (1.0, 2.0, 5.0)
            values = [float(step * decade) for decade in decades for step in steps]
        else:
            step = 10.0 ** np.floor(np.log10((self.high - self.low) / 2.0))
            step *= next(m for m in (1.0, 2.0, 5.0) if (self.high - self.low) / (m * step) <= 6)
            values = list(np.arange(np.ceil(self.low / step), self.high / step + 1e-9) * step)
        return [value for value in values if self.low <= value <= self.high]


def _axis(values: NDArray[np.float64], start: float, end: float) -> _Axis:
    low, high = float(values.min()), float(values.max())
    if low > 0 and high / low > LOG_FROM:
        return _Axis(low / 1.3, high * 1.3, True, start, end)
    pad = 0.06 * (high - low) or max(abs(high), 1.0) * 0.1
    return _Axis(low - pad, high + pad, False, start, end)


def _mark(x: float, y: float, view: int, title: str) -> str:
    style = view % VIEW_STYLES
    shapes = (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.4"',
        f'<rect x="{x - 3.1:.1f}" y="{y - 3.1:.1f}" width="6.2" height="6.2"',
        f'<path d="M{x:.1f} {y - 4.2:.1f}l4 7h-8z"',
        f'<path d="M{x:.1f} {y - 4.4:.1f}l4.4 4.4l-4.4 4.4l-4.4-4.4z"',
        f'<path d="M{x:.1f} {y + 4.2:.1f}l4-7h-8z"',
        f'<rect x="{x - 4.4:.1f}" y="{y - 2.2:.1f}" width="8.8" height="4.4"',
    )
    name = "circle" if style == 0 else "rect" if style in (1, 5) else "path"
    return f'{shapes[style]} class="v{style}"><title>{escape(title)}</title></{name}>'


def view_key(view: int) -> Markup:
    """Return the mark of a view for a legend."""
    return Markup(
        f'<svg class="key" viewBox="0 0 12 12" aria-hidden="true">{_mark(6, 6, view, "")}</svg>'
    )


def scatter(points: Points, *, x_title: str, y_title: str, summary: str) -> Markup:
    """Return an SVG of points with two axes; `summary` is what a screen reader says.

    Points without a finite x and y are left out; without any, a line says so.
    """
    shown = np.isfinite(points.x) & np.isfinite(points.y)
    if not shown.any():
        return Markup('<p class="quiet">Nothing was measured.</p>')
    across = _axis(points.x[shown], LEFT, WIDTH - RIGHT)
    up = _axis(points.y[shown], HEIGHT - BOTTOM, TOP)
    parts = [
        f'<svg class="chart" viewBox="0 0 {WIDTH:.0f} {HEIGHT:.0f}" role="img" '
        f'aria-label="{escape(summary)}">'
    ]
    for tick in up.ticks():
        y = up.place(tick)
        parts.append(f'<path class="grid" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/>')
        parts.append(f'<text x="{LEFT - 6}" y="{y + 4:.1f}" class="end">{_tick(tick)}</text>')
    for tick in across.ticks():
        x = across.place(tick)
        parts.append(f'<path class="grid" d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}"/>')
        parts.append(
            f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 15}" class="mid">{_tick(tick)}</text>'
        )
    parts += [
        _mark(
            across.place(points.x[i]), up.place(points.y[i]), int(points.view[i]), points.label[i]
        )
        for i in np.flatnonzero(shown)
    ]
    scale = " (log)" if up.log else ""
    middle_x, middle_y = (LEFT + WIDTH - RIGHT) / 2, (TOP + HEIGHT - BOTTOM) / 2
    parts.append(
        f'<text x="{middle_x}" y="{HEIGHT - 6}" class="mid">{escape(x_title)}</text>'
        f'<text transform="translate(12 {middle_y}) rotate(-90)" class="mid">'
        f"{escape(y_title + scale)}</text></svg>"
    )
    return Markup("".join(parts))


def _tick(value: float) -> str:
    """Return a mark's number, at most seven characters wide."""
    if value == 0 or 1e-3 <= abs(value) < 1e4:
        return f"{value:.3g}".replace("-", "−")
    digits, exponent = f"{value:.1e}".split("e")
    return f"{digits}e{int(exponent)}".replace("-", "−")
