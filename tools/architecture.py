"""Draws docs/images/architecture.svg: the packages' folders in layers, from their imports.

Run `python tools/architecture.py` after a folder begins or ceases to import another.
"""

from collections.abc import Mapping
from html import escape
from itertools import pairwise

from tools.import_graph import (
    PACKAGES,
    ROOT,
    Graph,
    Source,
    module_graph,
    read_sources,
    sibling_graph,
)
from tools.layered_layout import Layout, Point, lay_out, transitive_reduction

PICTURE = ROOT / "docs" / "images" / "architecture.svg"
LEFT_OUT = ("errors",)  # imported by nearly all
BOX_HEIGHT, ROW_HEIGHT, GAP, MARGIN = 30, 62, 16, 26
TITLE_HEIGHT = 52
SUBTITLES = {
    "validation": "scores one against the other",
    "rockshape": "measures rocks",
    "synth": "makes rocks of known shape",
}
STYLE = """
text { font-family: system-ui, "Segoe UI", "DejaVu Sans", sans-serif; fill: #1f2933; }
.page { fill: #ffffff; }
.panel { stroke-width: 1.2; }
.validation .panel { fill: #f3effa; stroke: #b9a5dc; } .validation .box { stroke: #7a5bb5; }
.rockshape .panel { fill: #fbf1e9; stroke: #e0b48f; } .rockshape .box { stroke: #b8682a; }
.synth .panel { fill: #eaf4f1; stroke: #9ccabb; } .synth .box { stroke: #2d8268; }
.box { fill: #ffffff; stroke-width: 1.3; }
.name { font-size: 14px; text-anchor: middle; }
.folder { font-weight: 600; }
.title { font-size: 19px; font-weight: 700; }
.subtitle, .note { font-size: 13.5px; fill: #52606d; }
.note { text-anchor: middle; }
.edge { fill: none; stroke: #7b8794; stroke-width: 1.25; marker-end: url(#tip); }
.knows { fill: none; stroke: #7a5bb5; stroke-width: 2.6; marker-end: url(#big-tip); }
#tip path { fill: #7b8794; } #big-tip path { fill: #7a5bb5; }
@media (prefers-color-scheme: dark) {
  text { fill: #e6edf3; } .page { fill: #0d1117; } .box { fill: #161b22; }
  .validation .panel { fill: #1b1528; stroke: #57428a; } .validation .box { stroke: #a78bdb; }
  .rockshape .panel { fill: #241910; stroke: #7d4f28; } .rockshape .box { stroke: #dd9a62; }
  .synth .panel { fill: #0f211c; stroke: #2f6b58; } .synth .box { stroke: #5fc0a3; }
  .subtitle, .note { fill: #9aa7b4; }
  .edge { stroke: #7d8894; } #tip path { fill: #7d8894; }
  .knows { stroke: #a78bdb; } #big-tip path { fill: #a78bdb; }
}
"""


def picture(sources: Mapping[str, Source]) -> str:
    """The whole SVG."""
    graph = module_graph(sources)
    layouts = {package: _layout(graph, package) for package in PACKAGES}
    sizes = {package: _panel_size(package, layout) for package, layout in layouts.items()}
    (left, left_height), (right, right_height) = sizes["rockshape"], sizes["synth"]
    width = max(sizes["validation"][0], left + right + MARGIN)
    spare = (width - left - right - MARGIN) / 2
    sizes["validation"] = width, sizes["validation"][1]
    sizes["rockshape"] = left + spare, max(left_height, right_height)
    sizes["synth"] = right + spare, max(left_height, right_height)
    below = sizes["validation"][1] + 2 * MARGIN + 34
    corners = {
        "validation": (MARGIN, MARGIN),
        "rockshape": (MARGIN, below),
        "synth": (width - right - spare + MARGIN, below),
    }
    height = below + sizes["rockshape"][1] + MARGIN
    parts = [
        _panel(package, layouts[package], corners[package], sizes[package], sources)
        for package in PACKAGES
    ]
    parts += [
        _knows(corners[package], sizes[package], MARGIN + sizes["validation"][1])
        for package in ("rockshape", "synth")
    ]
    note = (
        f'<text class="note" x="{MARGIN + width / 2:.1f}" y="{below - MARGIN - 12:.1f}">'
        "only validation imports both</text>"
    )
    return "\n".join([_head(width + 2 * MARGIN, height), *parts, note, "</svg>", ""])


def _layout(graph: Graph, package: str) -> Layout:
    between = sibling_graph(graph, package)
    left_out = {f"{package}.{name}" for name in LEFT_OUT}
    kept = {node: targets - left_out for node, targets in between.items() if node not in left_out}
    return lay_out(transitive_reduction(kept), width_of=_box_width, gap=GAP)


def _label(name: str) -> str:
    return name.rpartition(".")[2]


def _box_width(name: str) -> float:
    return 8.6 * len(_label(name)) + 24


def _panel_size(package: str, layout: Layout) -> tuple[float, float]:
    title = 12 * len(package) + 7.6 * len(SUBTITLES[package]) + 10
    height = TITLE_HEIGHT + (layout.layers - 1) * ROW_HEIGHT + BOX_HEIGHT + MARGIN
    return max(layout.width, title) + 2 * MARGIN, height


def _head(width: float, height: float) -> str:
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
        f'width="{width:.0f}" height="{height:.0f}" role="img" '
        'aria-label="Folders of the three packages in layers; arrows are imports">\n'
        f"<style>{STYLE}</style>\n<defs>{_tip('tip', 7)}{_tip('big-tip', 4.5)}</defs>\n"
        f'<rect class="page" width="{width:.0f}" height="{height:.0f}" rx="10"/>'
    )


def _tip(name: str, size: float) -> str:
    return (
        f'<marker id="{name}" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="{size}" '
        f'markerHeight="{size}" orient="auto"><path d="M0 1 10 5 0 9z"/></marker>'
    )


def _panel(
    package: str,
    layout: Layout,
    corner: Point,
    size: tuple[float, float],
    sources: Mapping[str, Source],
) -> str:
    """A package's frame with its boxes and arrows."""
    x, y = corner
    shift = x + (size[0] - layout.width) / 2
    top = y + TITLE_HEIGHT + BOX_HEIGHT / 2

    def place(point: Point) -> Point:
        return shift + point[0], top + point[1] * ROW_HEIGHT

    lines = [
        f'<g class="{package}">',
        f'<rect class="panel" x="{x:.1f}" y="{y:.1f}" width="{size[0]:.1f}" '
        f'height="{size[1]:.1f}" rx="12"/>',
        f'<text x="{x + 18:.1f}" y="{y + 30:.1f}"><tspan class="title">{package}</tspan>'
        f'<tspan class="subtitle" dx="10">{SUBTITLES[package]}</tspan></text>',
    ]
    lines += [_edge([place(point) for point in points]) for points in layout.edges.values()]
    lines += [_box(name, place(at), sources[name]) for name, at in sorted(layout.centres.items())]
    return "\n".join([*lines, "</g>"])


def _edge(points: list[Point]) -> str:
    """A smooth line from the lower side of a box to the upper side of another."""
    half = BOX_HEIGHT / 2
    x, y = points[0]
    path = f"M{x:.1f} {y + half:.1f}"
    for (x, y), (next_x, next_y) in pairwise(points):
        start, end = y + half, next_y - half
        middle = (start + end) / 2
        path += f"C{x:.1f} {middle:.1f} {next_x:.1f} {middle:.1f} {next_x:.1f} {end:.1f}"
        if (next_x, next_y) != points[-1]:
            path += f"V{next_y + half:.1f}"
    return f'<path class="edge" d="{path}"/>'


def _box(name: str, centre: Point, source: Source) -> str:
    x, y = centre
    width = _box_width(name)
    is_folder = source.path.name == "__init__.py"
    return (
        f'<rect class="box" x="{x - width / 2:.1f}" y="{y - BOX_HEIGHT / 2:.1f}" '
        f'width="{width:.1f}" height="{BOX_HEIGHT}" rx="{7 if is_folder else 15}"/>'
        f'<text class="name{" folder" if is_folder else ""}" x="{x:.1f}" y="{y + 5:.1f}">'
        f"{escape(_label(name))}</text>"
    )


def _knows(corner: Point, size: tuple[float, float], start: float) -> str:
    x = corner[0] + size[0] / 2
    return f'<path class="knows" d="M{x:.1f} {start:.1f}V{corner[1] - 2:.1f}"/>'


if __name__ == "__main__":
    PICTURE.write_text(picture(read_sources()), encoding="utf-8")
