"""Draws the figures of docs/measures.md, one a measure, by the measures' own code.

Run `python tools/measure_figures.py`; the pictures go to docs/images/measures/. The drawn rocks
come from `synth`, so that their true form is known.
"""

from pathlib import Path

import cv2
import matplotlib as mpl
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Polygon
from numpy.typing import NDArray

from rockshape.ellipse.direct import Ellipse, fit_ellipse
from rockshape.measures.sphericity_3d import sphericity_3d
from rockshape.outline.extent import feret_diameters
from rockshape.outline.trace import trace_outline
from rockshape.surface import fit_surface, view_patch
from synth.shapes.series import Shape, shape_series

FOLDER = Path(__file__).parent.parent / "docs" / "images" / "measures"
INK, ROCK, FIRST, SECOND, QUIET = "#1d2329", "#d9cfc1", "#1f6fb2", "#c4561b", "#8b9299"
SEED = 12
Floats = NDArray[np.float64]


def main() -> None:
    """Draw them all."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    mpl.rcParams.update({"font.size": 9, "text.color": INK, "axes.edgecolor": QUIET})
    for draw in (
        axis_ratio,
        ellipse_error,
        sphericity_2d,
        angularity_2d,
        roundness,
        ellipsoid_error,
        sphericity_3d_figure,
        angularity_3d,
    ):
        figure = draw()
        name = draw.__name__.removesuffix("_figure")
        path = FOLDER / f"{name}.png"
        figure.savefig(path, dpi=120, metadata={"Software": None})
        plt.close(figure)
        _shrink(path)


def _shrink(path: Path) -> None:
    """Keep a drawing of few colours as a palette of 64."""
    from PIL import Image  # noqa: PLC0415 - beside matplotlib's own

    Image.open(path).convert("RGB").quantize(64, method=Image.Quantize.MEDIANCUT).save(
        path, optimize=True
    )


def _panels(count: int) -> tuple[plt.Figure, list[Axes]]:
    figure, axes = plt.subplots(1, count, figsize=(6.4, 2.5), layout="constrained")
    panels = [axes] if count == 1 else list(axes)
    for panel in panels:
        panel.set_aspect("equal")
        panel.axis("off")
    return figure, panels


def _shapes() -> list[Shape]:
    """Four rocks from angular to round, of one form."""
    rng = np.random.default_rng(SEED)
    return shape_series("roundness", count=4, rng=rng)


def _outline(shape: Shape, *, turn_rad: float = 0.0, scale: float = 1.0) -> Floats:
    """A shape's exact outline as pixels see it: boundary pixels, y down."""
    points = shape.outline.outline_px() * (scale, -scale)
    cosine, sine = np.cos(turn_rad), np.sin(turn_rad)
    points = points @ np.array([[cosine, sine], [-sine, cosine]])
    points -= points.min(axis=0) - 5
    mask = np.zeros(np.ceil(points.max(axis=0)[::-1]).astype(int) + 6, dtype=np.uint8)
    cv2.fillPoly(mask, [np.rint(points * 16).astype(np.int32)], 1, shift=4)
    return trace_outline(mask.astype(bool))


def _rock(panel: Axes, outline: Floats) -> None:
    panel.add_patch(Polygon(outline, facecolor=ROCK, edgecolor=INK, linewidth=1.2))
    panel.autoscale_view()
    panel.invert_yaxis()


def _fitted(outline: Floats) -> Ellipse:
    ellipse = fit_ellipse(outline)
    if ellipse is None:
        raise ValueError("outline: expected one that determines an ellipse")
    return ellipse


def _ring(ellipse: Ellipse) -> Floats:
    turns = np.linspace(0, 2 * np.pi, 200)
    return _on(ellipse, turns)


def _on(ellipse: Ellipse, turns: Floats) -> Floats:
    cosine, sine = np.cos(ellipse.angle_rad), np.sin(ellipse.angle_rad)
    u, v = ellipse.major * np.cos(turns), ellipse.minor * np.sin(turns)
    return np.column_stack([ellipse.x + u * cosine - v * sine, ellipse.y + u * sine + v * cosine])


def axis_ratio() -> plt.Figure:
    """The ellipse and its half-axes."""
    figure, panels = _panels(3)
    rng = np.random.default_rng(SEED)
    for panel, shape in zip(panels, shape_series("sphericity", count=3, rng=rng), strict=True):
        outline = _outline(shape)
        ellipse = _fitted(outline)
        _rock(panel, outline)
        panel.plot(*_ring(ellipse).T, color=FIRST, linewidth=1.4)
        centre = np.array([ellipse.x, ellipse.y])
        for turn, name, colour in ((0.0, "a", FIRST), (np.pi / 2, "b", SECOND)):
            end = _on(ellipse, np.array([turn]))[0]
            panel.plot(*np.array([centre, end]).T, color=colour, linewidth=1.6)
            aside = np.array([3.0, 11.0]) if name == "a" else np.array([11.0, 3.0])
            panel.annotate(
                name,
                (centre + end) / 2 + aside,
                color=colour,
                weight="bold",
                ha="center",
                va="center",
            )
        panel.set_title(f"b/a = {ellipse.axis_ratio:.2f}", fontsize=9)
    return figure


def ellipse_error() -> plt.Figure:
    """Rays from the centre, and how far the outline lies from the ellipse along them."""
    figure, panels = _panels(2)
    shapes = _shapes()
    for panel, shape, words in zip(
        panels, (shapes[0], shapes[3]), ("angular", "round"), strict=True
    ):
        outline = _outline(shape)
        ellipse = _fitted(outline)
        _rock(panel, outline)
        panel.plot(*_ring(ellipse).T, color=FIRST, linewidth=1.4)
        centre = np.array([ellipse.x, ellipse.y])
        distance = ellipse.radial_distance(outline)
        for point, along in list(zip(outline, distance, strict=True))[::9]:
            ray = point - centre
            foot = point - ray / np.hypot(*ray) * along
            panel.plot(*np.array([point, foot]).T, color=SECOND, linewidth=1.6)
        mean = float(np.mean(distance**2))
        size = np.sqrt(ellipse.major * ellipse.minor)
        panel.set_title(
            f"{words}\nmean square {mean:.1f} px², RMS/√(ab) {np.sqrt(mean) / size:.3f}",
            fontsize=9,
        )
    return figure


def sphericity_2d() -> plt.Figure:
    """The upright box and the Feret diameters, of a rock and of the same rock turned."""
    figure, panels = _panels(2)
    rng = np.random.default_rng(SEED)
    shape = shape_series("sphericity", count=3, rng=rng)[1]
    for panel, turn_rad in zip(panels, (0.0, np.pi / 4), strict=True):
        outline = _outline(shape, turn_rad=turn_rad)
        _rock(panel, outline)
        low, high = outline.min(axis=0), outline.max(axis=0)
        box = np.array([low, (high[0], low[1]), high, (low[0], high[1]), low])
        panel.plot(*box.T, color=SECOND, linewidth=1.4, linestyle="--")
        for ends in _feret_ends(outline):
            panel.annotate(
                "",
                *ends,
                arrowprops={"arrowstyle": "|-|", "color": FIRST, "linewidth": 1.4, "shrinkA": 0}
                | {"shrinkB": 0, "mutation_scale": 4},
            )
        upright = (high - low).min() / (high - low).max()
        least, greatest = feret_diameters(outline)
        panel.set_title(f"upright box {upright:.2f}, callipers {least / greatest:.2f}", fontsize=9)
        panel.margins(0.04)
        panel.autoscale_view()
    return figure


def _feret_ends(outline: Floats) -> list[tuple[Floats, Floats]]:
    """Ends of the least and the greatest of the diameters by whole degrees, through the middle."""
    turns = np.radians(np.arange(180))
    ways = np.column_stack([np.cos(turns), np.sin(turns)])
    reach = outline @ ways.T
    middle = (outline.min(axis=0) + outline.max(axis=0)) / 2
    found = []
    for place in (np.ptp(reach, axis=0).argmin(), np.ptp(reach, axis=0).argmax()):
        way = ways[place]
        start, end = reach[:, place].min(), reach[:, place].max()
        found.append((middle + (start - middle @ way) * way, middle + (end - middle @ way) * way))
    return found


def angularity_2d() -> plt.Figure:
    """Flattest angles along an angular and a round outline, beside one triangle of each kind."""
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(6.4, 2.5), layout="constrained", width_ratios=(1, 1.6)
    )
    left.set_aspect("equal")
    left.axis("off")
    shapes = _shapes()
    outline = _outline(shapes[0], scale=0.3)
    _rock(left, outline)
    left.plot(*outline.T, "s", color=INK, markersize=1.5)
    flattest = _flattest_deg(outline)
    for index, colour in ((int(flattest.argmin()), SECOND), (int(flattest.argmax()), FIRST)):
        for reach in (3, 5, 8):
            triangle = outline[[index - reach, index, (index + reach) % len(outline)]]
            left.add_patch(Polygon(triangle, fill=False, edgecolor=colour, linewidth=1.2))
        left.plot(*outline[index], "o", color=colour, markersize=4)
    for shape, colour, words in ((shapes[0], SECOND, "angular"), (shapes[3], FIRST, "round")):
        angles = _flattest_deg(_outline(shape))
        along = np.linspace(0, 1, len(angles))
        spread = angles.std(ddof=1)
        right.plot(along, angles, color=colour, linewidth=1, label=f"{words}: spread {spread:.1f}°")
    right.set_xlabel("along the outline")
    right.set_ylabel("flattest angle, °")
    right.set_ylim(100, 182)
    right.legend(frameon=False, fontsize=8, loc="lower right", ncols=2)
    right.spines[["top", "right"]].set_visible(False)
    return figure


def _flattest_deg(outline: Floats) -> Floats:
    """The flattest of each point's 36 angles (n,), by the definition and one at a time."""
    best = np.zeros(len(outline))
    for before in range(3, 9):
        for after in range(3, 9):
            first = np.roll(outline, before, axis=0) - outline
            second = np.roll(outline, -after, axis=0) - outline
            lengths = np.hypot(*first.T) * np.hypot(*second.T)
            cosine = (first * second).sum(axis=1) / lengths
            best = np.maximum(best, np.degrees(np.arccos(np.clip(cosine, -1, 1))))
    return best


def roundness() -> plt.Figure:
    """The largest inscribed circle and the circles of the corners."""
    figure, panels = _panels(3)
    for panel, shape in zip(panels, _shapes()[:3], strict=True):
        polygon = shape.outline
        panel.add_patch(Polygon(polygon.outline_px(), facecolor=ROCK, edgecolor=INK, linewidth=1.2))
        for corner in polygon.corners_px:
            panel.add_patch(
                Circle(corner, polygon.radius_px, fill=False, edgecolor=SECOND, linewidth=1.4)
            )
        centre, radius = _largest_disc(polygon.outline_px())
        panel.add_patch(Circle(centre, radius, fill=False, edgecolor=FIRST, linewidth=1.4))
        panel.set_title(f"mean r / R = {polygon.roundness():.2f}", fontsize=9)
        panel.margins(0.04)
        panel.autoscale_view()
    return figure


def _largest_disc(outline: Floats) -> tuple[Floats, float]:
    """Centre and radius of the largest disc within an outline, to a pixel."""
    low = outline.min(axis=0) - 2
    size = np.ceil(outline.max(axis=0) - low).astype(int) + 3
    mask = np.zeros(size[::-1], dtype=np.uint8)
    cv2.fillPoly(mask, [np.rint((outline - low) * 16).astype(np.int32)], 1, shift=4)
    depth = cv2.distanceTransform(mask, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    row, col = np.unravel_index(int(depth.argmax()), depth.shape)
    return low + np.array([col, row]), float(depth.max())


def _section() -> tuple[Floats, Floats]:
    """A rock's cross-section (n, 2) in metres and which part a camera on the left sees."""
    corners = _shapes()[1].outline.outline_px() / 1000
    ring = np.vstack([corners, corners[:1]])
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(ring, axis=0).T))])
    places = np.linspace(0, along[-1], 180, endpoint=False)
    points = np.column_stack([np.interp(places, along, part) for part in ring.T])
    points -= points.mean(axis=0)
    bearing = np.arctan2(points[:, 1], points[:, 0])
    return points, np.abs(np.abs(bearing) - np.pi) < 1.5


def ellipsoid_error() -> plt.Figure:
    """A section through a rock, the points seen from one side and the ellipsoid through them."""
    figure, (panel,) = _panels(1)
    points, seen = _section()
    panel.add_patch(Polygon(points, facecolor=ROCK, edgecolor=QUIET, linewidth=1, linestyle=":"))
    visible = points[seen][::2]
    ellipse = _fitted(points)
    panel.plot(*_ring(ellipse).T, color=FIRST, linewidth=1.4)
    centre = np.array([ellipse.x, ellipse.y])
    for point, along in zip(visible, ellipse.radial_distance(visible), strict=True):
        ray = point - centre
        foot = point - ray / np.hypot(*ray) * along
        panel.plot(*np.array([point, foot]).T, color=SECOND, linewidth=1.4)
    panel.plot(*visible.T, "o", color=INK, markersize=1.6)
    left = points[:, 0].min()
    for side in (-0.05, 0.0, 0.05):
        panel.annotate(
            "",
            (left - 0.006, side),
            (left - 0.06, side),
            arrowprops={"arrowstyle": "->", "color": QUIET},
        )
    panel.set_title(
        "points seen from the left, and how far they lie from the ellipsoid", fontsize=9
    )
    panel.margins(0.04)
    panel.autoscale_view()
    return figure


def sphericity_3d_figure() -> plt.Figure:
    """Four ellipsoids and their sphericity."""
    figure, panels = _panels(4)
    forms = (
        ("sphere", (1.0, 1.0, 1.0)),
        ("blade", (1.0, 0.7, 0.4)),
        ("disc", (1.0, 1.0, 0.4)),
        ("rod", (1.0, 0.4, 0.4)),
    )
    for panel, (words, half_axes) in zip(panels, forms, strict=True):
        panel.imshow(_shaded(np.array(half_axes)), cmap="gray", vmin=0, vmax=1)
        value = sphericity_3d(np.array(half_axes))
        axes = " : ".join(f"{axis:g}" for axis in half_axes)
        panel.set_title(f"{words} {axes}\n(c²/ab)$^{{1/3}}$ = {value:.2f}", fontsize=9)
    return figure


def _shaded(half_axes: Floats, *, size: int = 150) -> Floats:
    """A picture of an ellipsoid, seen from above its end, under one light; white where none is."""
    tilt, turn = 0.5, 0.6
    about_up = np.array(
        [[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]]
    )
    down = np.array([[1, 0, 0], [0, np.sin(tilt), -np.cos(tilt)], [0, np.cos(tilt), np.sin(tilt)]])
    # from picture axes (x right, y up, z to the viewer) to the ellipsoid's own
    own = about_up.T @ down.T
    y, x = np.mgrid[1.05 : -1.05 : size * 1j, -1.05 : 1.05 : size * 1j]
    origin = np.stack([x, y, np.zeros_like(x)], axis=-1) @ own.T / half_axes
    direction = own @ np.array([0.0, 0.0, 1.0]) / half_axes
    b, c = origin @ direction, (origin**2).sum(-1) - 1
    root = b**2 - direction @ direction * c
    hit = root >= 0
    depth = (-b + np.sqrt(np.where(hit, root, 0))) / (direction @ direction)
    normal = ((origin + depth[..., None] * direction) / half_axes) @ own
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    light = np.array([-0.5, 0.6, 0.62])
    return np.where(hit, 0.25 + 0.65 * np.clip(normal @ light, 0, 1), 1.0)


def angularity_3d() -> plt.Figure:
    """Surfaces of two reliefs: the height through the middle and its second derivative."""
    figure, panels = plt.subplots(2, 2, figsize=(6.4, 2.8), layout="constrained", sharex=True)
    for column, (words, amplitude) in enumerate((("smooth", 0.0), ("rough", 0.002))):
        points = _dome(amplitude)
        patch = view_patch(points)
        surface = None if patch is None else fit_surface(patch)
        if patch is None or surface is None:
            raise ValueError("points: expected a patch that determines a surface")
        middle = np.abs(patch.w_m) < 0.0008
        order = np.argsort(patch.u_m[middle])
        u_mm = 1000 * patch.u_m[middle][order]
        mean = (surface.second_uu_per_m + surface.second_ww_per_m) / 2
        panels[0, column].plot(u_mm, 1000 * patch.height_m[middle][order], color=INK)
        panels[1, column].fill_between(u_mm, mean[middle][order], color=SECOND, alpha=0.6)
        panels[1, column].axhline(0, color=QUIET, linewidth=0.8)
        panels[1, column].set_ylim(-40, 40)
        panels[1, column].set_xlabel("across, mm")
        panels[0, column].set_title(
            f"{words}: mean |(Q$_{{uu}}$ + Q$_{{ww}}$)/2| = {np.abs(mean).mean():.1f}", fontsize=9
        )
    panels[0, 0].set_ylabel("height, mm")
    panels[1, 0].set_ylabel("1/m")
    for panel in panels.flat:
        panel.spines[["top", "right"]].set_visible(False)
    return figure


def _dome(amplitude_m: float) -> Floats:
    """Points of a cap of a sphere of 0.2 m with waves on it, seen from 3 m."""
    x, y = np.mgrid[-0.1:0.1:141j, -0.1:0.1:141j]
    inside = np.hypot(x, y) < 0.1
    height = np.sqrt(0.2**2 - x**2 - y**2)
    height += amplitude_m * np.sin(2 * np.pi * x / 0.06) * np.cos(2 * np.pi * y / 0.07)
    return np.stack([x, y, 3.0 - height], axis=-1)[inside]


if __name__ == "__main__":
    main()
