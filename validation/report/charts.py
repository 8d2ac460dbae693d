"""Charts as inline SVG, coloured by the page's style so that they follow light and dark.

A point is a link to its rock; where points are too many, shades tell how many lie where, and the
points worth a look stand on them.
"""

from dataclasses import dataclass

import numpy as np
from markupsafe import Markup, escape
from numpy.typing import NDArray

from validation.report.svg_axes import Axis, axis_of, grid_rows, tick_text

WIDTH, HEIGHT = 340.0, 250.0
LEFT, RIGHT, TOP, BOTTOM = 62.0, 12.0, 14.0, 40.0
VIEW_STYLES = 6  # colours and marks repeat after so many views
CELLS = (30, 22)  # of shades, across and down
SHADES = 5

_SHAPES = (
    '<circle r="3.4"/>',
    '<path d="M-3.1-3.1h6.2v6.2h-6.2z"/>',
    '<path d="M0-4.2l4 7h-8z"/>',
    '<path d="M0-4.4l4.4 4.4l-4.4 4.4l-4.4-4.4z"/>',
    '<path d="M0 4.2l4-7h-8z"/>',
    '<path d="M-4.4-2.2h8.8v4.4h-8.8z"/>',
)


@dataclass(frozen=True, eq=False)
class Points:
    """What a chart shows: one point a rock and view."""

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    drawn: NDArray[np.intp]  # which are drawn as points; the others are in the shades alone
    view: tuple[int, ...]  # of those drawn, as all below
    label: tuple[str, ...]
    place: tuple[str | None, ...]  # the rock's place in the page; None where it has none


def mark_symbols() -> Markup:
    """Marks of the views, which every chart draws on."""
    return Markup("".join(f'<g id="k{i}">{shape}</g>' for i, shape in enumerate(_SHAPES)))


def view_key(view: int) -> Markup:
    """Mark of a view for a legend."""
    style = view % VIEW_STYLES
    return Markup(
        f'<svg class="key" viewBox="-6 -6 12 12" aria-hidden="true">'
        f'<use href="#k{style}" class="v{style}"/></svg>'
    )


def scatter(
    points: Points, *, x_title: str, y_title: str, summary: str, unshown: str = "unshown"
) -> Markup:
    """SVG of points with two axes; `summary` is what a screen reader says.

    Points without a finite x and y are left out; without any, a line says so. A point whose rock
    the page does not show leads to the place `unshown`.
    """
    finite = np.isfinite(points.x) & np.isfinite(points.y)
    if not finite.any():
        return Markup('<p class="quiet">Nothing was measured.</p>')
    across = axis_of(points.x[finite], LEFT, WIDTH - RIGHT, straight=True)
    up = axis_of(points.y[finite], HEIGHT - BOTTOM, TOP)
    x, y = np.full(points.x.shape, np.nan), np.full(points.y.shape, np.nan)
    x[finite], y[finite] = across.places(points.x[finite]), up.places(points.y[finite])
    parts = [
        f'<svg class="chart" viewBox="0 0 {WIDTH:.0f} {HEIGHT:.0f}" role="group" '
        f'aria-label="{escape(summary)}">',
        _grid(across, up),
    ]
    if points.drawn.size < points.x.size:
        parts.append(_shades(x[finite], y[finite]))
    order = sorted(
        (i for i, row in enumerate(points.drawn) if finite[row]),
        key=lambda i: float(x[points.drawn[i]]),
    )
    for turn, i in enumerate(order):
        row, style = points.drawn[i], points.view[i] % VIEW_STYLES
        place = points.place[i]
        link = f'href="#{escape(unshown)}" class="bare"' if place is None else f'href="#{place}"'
        parts.append(
            f'<a {link} data-view="{points.view[i]}" tabindex="{0 if turn == 0 else -1}">'
            f'<use href="#k{style}" class="v{style}" x="{x[row]:.1f}" y="{y[row]:.1f}"/>'
            f"<title>{escape(points.label[i])}</title></a>"
        )
    middle_x, middle_y = (LEFT + WIDTH - RIGHT) / 2, (TOP + HEIGHT - BOTTOM) / 2
    parts.append(
        f'<text x="{middle_x}" y="{HEIGHT - 6}" class="mid">{escape(x_title)}</text>'
        f'<text transform="translate(12 {middle_y}) rotate(-90)" class="mid">'
        f"{escape(y_title + (' (log)' if up.log else ''))}</text></svg>"
    )
    return Markup("".join(parts))


def _grid(across: Axis, up: Axis) -> str:
    parts = [grid_rows(up, LEFT, WIDTH - RIGHT)]
    for tick in across.ticks():
        x = across.place(tick)
        parts.append(f'<path class="grid" d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}"/>')
        parts.append(
            f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 15}" class="mid">{tick_text(tick)}</text>'
        )
    return "".join(parts)


def _shades(x: NDArray[np.float64], y: NDArray[np.float64]) -> str:
    """Cells shaded by how many points they hold, on a logarithmic scale."""
    box = ((LEFT, WIDTH - RIGHT), (TOP, HEIGHT - BOTTOM))
    counts, edges_x, edges_y = np.histogram2d(x, y, bins=CELLS, range=box)
    scale = np.log1p(counts) / np.log1p(counts.max())
    level = np.ceil(scale * SHADES).astype(int)
    wide, high = edges_x[1] - edges_x[0], edges_y[1] - edges_y[0]
    return "".join(
        f'<path class="shade s{shade}" d="'
        + "".join(
            f"M{edges_x[i]:.1f} {edges_y[j]:.1f}h{wide:.1f}v{high:.1f}h-{wide:.1f}z"
            for i, j in np.argwhere(level == shade)
        )
        + '"/>'
        for shade in range(1, SHADES + 1)
        if (level == shade).any()
    )


def span(value: float, low: float, high: float, *, start: float, end: float) -> Markup:
    """Value as a dot with its interval as a line, on the way from `start` to `end`."""
    if not np.isfinite(value):
        return Markup("")

    def at(number: float) -> float:
        return 4 + 112 * (min(max(number, start), end) - start) / (end - start)

    line = f'<path d="M{at(low):.1f} 7H{at(high):.1f}"/>' if np.isfinite(low) and high > low else ""
    zero = f'<path class="grid" d="M{at(0):.1f} 0V14"/>' if start < 0 < end else ""
    return Markup(
        '<svg class="span" viewBox="0 0 120 14" aria-hidden="true">'
        f'<path class="grid" d="M4 7H116"/>{zero}{line}<circle cx="{at(value):.1f}" cy="7" r="4"/>'
        "</svg>"
    )
