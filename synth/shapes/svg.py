"""SVG of a drawing: what the pen drew, and the exact outlines beside it, hidden."""

from collections.abc import Sequence

from synth.arrays import Floats
from synth.shapes.outline import RoundedPolygon
from synth.shapes.shape import Shape

_EVERY = 2  # points of the pen's line that are kept: one a pixel
_PAPER, _FILL, _INK = "#ececec", "#a8a8a8", "#282828"
_PEN_WIDTH_PX = 2.5


def svg_text(
    shapes: Sequence[Shape],
    drawn_px: Sequence[Floats],
    middles_px: Floats,
    *,
    shape: tuple[int, ...],
) -> str:
    """SVG of a drawing of `shape` (rows, cols), in pixels.

    The group `drawn` holds the pen's lines as `rock-1`, `rock-2` and so on; the group `exact`,
    not displayed, the outlines they stray from, in lines and circular arcs. SVG counts from the
    corner of the first pixel: its coordinates are the pixels' own plus one half.
    """
    rows, cols = shape
    drawn = "\n".join(
        f'<path id="rock-{number}" d="{_polyline(line[::_EVERY] + 0.5)}"/>'
        for number, line in enumerate(drawn_px, start=1)
    )
    exact = "\n".join(
        f'<path id="exact-{number}" d="{_arcs(one.outline, middle + 0.5)}"/>'
        for number, (one, middle) in enumerate(zip(shapes, middles_px, strict=True), start=1)
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{cols}" height="{rows}" '
        f'viewBox="0 0 {cols} {rows}">\n'
        f'<rect width="{cols}" height="{rows}" fill="{_PAPER}"/>\n'
        f'<g id="drawn" fill="{_FILL}" stroke="{_INK}" stroke-width="{_PEN_WIDTH_PX}" '
        f'stroke-linejoin="round">\n{drawn}\n</g>\n'
        f'<g id="exact" display="none" fill="none" stroke="#c00000">\n{exact}\n</g>\n</svg>\n'
    )


def _polyline(points_px: Floats) -> str:
    return "M" + "L".join(f"{x:.2f},{y:.2f}" for x, y in points_px) + "Z"


def _arcs(outline: RoundedPolygon, middle_px: Floats) -> str:
    """Rounded polygon's path: an arc at each corner, a line to the next."""
    radius = outline.radius_px
    parts: list[str] = []
    for start, end in middle_px + outline.joints_px() * [1.0, -1.0]:
        command = "L" if parts else "M"
        parts.append(f"{command}{start[0]:.6f},{start[1]:.6f}")
        parts.append(f"A{radius:.6f} {radius:.6f} 0 0 0 {end[0]:.6f},{end[1]:.6f}")
    return "".join(parts) + "Z"
