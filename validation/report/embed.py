"""Pictures inside the page: each JPEG once, and the lines over it as SVG."""

import base64
from collections.abc import Sequence

from markupsafe import Markup, escape

from validation.records.pictures import TRUE, UNITS, Mark, Portrait

SLICE = 'preserveAspectRatio="xMidYMid slice"'  # fills the place it is shown in


def data_uri(jpeg: bytes) -> str:
    """JPEG as an address that holds it."""
    return "data:image/jpeg;base64," + base64.b64encode(jpeg).decode("ascii")


def outline_path(outline: Sequence[int]) -> str:
    """Closed outline x, y, x, y, … as an SVG path of relative steps."""
    steps = [f"M{outline[0]} {outline[1]}l"]
    for i in range(2, len(outline), 2):
        dx, dy = outline[i] - outline[i - 2], outline[i + 1] - outline[i - 1]
        space = " " if len(steps) > 1 and dx >= 0 else ""
        steps.append(f"{space}{dx}{' ' if dy >= 0 else ''}{dy}")
    return "".join(steps) + "z"


def mark_lines(mark: Mark) -> Markup:
    """Mark's ellipse and outline; the true border is of another style."""
    style = "true" if mark.method == TRUE else "found"
    lines = f'<path class="{style}" d="{outline_path(mark.outline)}"/>' if mark.outline else ""
    if mark.ellipse is not None:
        x, y, major, minor, turn = mark.ellipse
        lines = (
            f'<ellipse class="fit" cx="{x}" cy="{y}" rx="{major}" ry="{minor}" '
            f'transform="rotate({turn} {x} {y})"/>{lines}'
        )
    return Markup(lines)


def centre(mark: Mark) -> tuple[float, float]:
    """Middle of a mark's outline, where its number stands."""
    across, down = mark.outline[0::2], mark.outline[1::2]
    return (min(across) + max(across)) / 2, (min(down) + max(down)) / 2


def symbols(name: str, portrait: Portrait) -> Markup:
    """Portrait's symbols: `name` is its picture, `name` and a method that one's lines."""
    picture = portrait.picture
    width, height = UNITS * picture.width_px, UNITS * picture.height_px
    start = f'<symbol id="{escape(name)}%s" viewBox="0 0 {width} {height}" {SLICE}>%s</symbol>'
    image = (
        f'<image width="{width}" height="{height}" preserveAspectRatio="none" '
        f'href="{data_uri(picture.jpeg)}"/>'
    )
    parts = [start % ("", image)]
    parts += [start % (f"-{escape(m.method)}", mark_lines(m)) for m in picture.marks]
    return Markup("".join(parts))
