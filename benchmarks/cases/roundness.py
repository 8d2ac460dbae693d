"""Wadell's roundness by size in pixels, on shapes whose roundness is known."""

from collections.abc import Callable, Iterable, Sequence
from functools import partial

import numpy as np
from case import Case, Cell, Column, Table
from scipy.spatial import ConvexHull
from silhouettes import CIRCLE, REPORTED_FROM, Floats, Mask, draw, fill, over_turns, turned

from rockshape.outline.edge import trace_edge
from rockshape.outline.form import form_of
from rockshape.outline.roundness import wadell_roundness
from synth.rocks import quarry
from synth.rocks.outlines import RoundedHull
from synth.rocks.outlines.record import plane_across
from synth.spec.rocks import RocksSpec

try:
    import fast_rs.rs as fast_rs
except ImportError:
    fast_rs = None


Reader = Callable[[Mask], float]


Shape = tuple[Callable[[float], Mask], float]  # its mask at a size, its roundness


FAST_RS_MAX_PX = 200  # its time grows with the square


def roundness_by_size(
    *,
    sizes_px: tuple[int, ...] = (30, 60, 100, 200, 500, 1000),
    charts: int = 3,
    scenes: int = 14,
    turns: int = 8,
) -> list[Table]:
    """Hold Wadell's roundness to shapes whose roundness is known."""
    polygons: list[Shape] = [
        (shape.mask, shape.truth()["roundness"])
        for chart in range(charts)
        for shape in draw("krumbein", seed=REPORTED_FROM + chart)
    ]
    shapes = {
        "rounded polygons": polygons,
        "rounded polyhedra": rock_outlines(range(REPORTED_FROM, REPORTED_FROM + scenes)),
    }
    readers: dict[str, Reader] = {"rockshape": _wadell}
    if fast_rs is not None:
        readers["fast_rs"] = lambda mask: float(fast_rs.rs_calculate(mask)[0][0])
    rows: list[tuple[Cell, ...]] = []
    for title, some in shapes.items():
        truth = np.array([known for _, known in some])
        for name, reader in readers.items():
            for size in sizes_px:
                if name == "fast_rs" and size > FAST_RS_MAX_PX:
                    continue
                found = np.array([reader(drawer(size)) for drawer, _ in some])
                error = found - truth
                figures = np.corrcoef(truth, found)[0, 1], error.mean(), _rms(error)
                rows.append((title, len(some), name, size, *figures))
    columns = (
        Column("shapes"),
        Column("number", "", "d"),
        Column("by"),
        Column("size", "px", "d"),
        Column("r", "", ".3f"),
        Column("bias", "", "+.3f"),
        Column("RMS error", "", ".3f"),
    )
    forms = []
    for name, (outline, exact) in _closed_forms().items():
        values = [over_turns(_wadell, outline * size / 2, turns) for size in sizes_px]
        forms.append((name, exact, *(f"{v.mean():.3f} ± {v.std():.3f}" for v in values)))
    heads = [Column(f"{size} px") for size in sizes_px]
    return [
        Table(columns, rows, name="shapes"),
        Table((Column("closed form"), Column("exact", "", ".2f"), *heads), forms, name="forms"),
    ]


def _wadell(mask: Mask) -> float:
    form = form_of(trace_edge(mask), staircase=True)
    return float("nan") if form is None else wadell_roundness(form)


def _rms(values: Floats) -> float:
    return float(np.sqrt(np.mean(values**2)))


def rock_outlines(seeds: Iterable[int]) -> list[Shape]:
    """Return outlines of rounded polyhedra, each seen from anywhere, with their roundness."""
    found: list[Shape] = []
    for seed in seeds:
        rng = np.random.default_rng(seed)
        for rock in quarry(RocksSpec(), rng=rng):
            if isinstance(rock.form, RoundedHull):
                across = plane_across(rng.normal(size=3))
                points = rock.form.vertices_m @ across.T
                corners = points[ConvexHull(points).vertices]
                swollen = (corners[:, None] + rock.form.radius_m * CIRCLE[::5]).reshape(-1, 2)
                outline = swollen[ConvexHull(swollen).vertices]
                known = rock.form.outline(across).roundness
                found.append((partial(_drawn, outline, int(rng.integers(2**31))), known))
    return found


def _drawn(outline: Floats, seed: int, size: float) -> Mask:
    rng = np.random.default_rng([seed, round(size)])
    turn, shift = rng.uniform(0, 2 * np.pi), rng.uniform(0, 1, 2)
    return fill(turned(outline * size / np.ptp(outline, axis=0).max(), turn) + shift)


def _closed_forms() -> dict[str, tuple[Floats, float]]:
    """Return outlines of half-length 1 and their roundness."""
    forms = {"disc": (CIRCLE, 1.0), "stadium 2:1": (box(0.5, 0.5), 1.0)}
    forms |= {f"ellipse {ratio}": (CIRCLE * (1, ratio), ratio) for ratio in (0.8, 0.4)}
    forms |= {f"square, radius {r}": (box(1.0, r), r) for r in (0.05, 0.2, 0.5)}
    return forms | {f"box 2:1, radius {r}": (box(0.5, r), 2 * r) for r in (0.05, 0.2)}


def box(half_width: float, radius: float) -> Floats:
    """Return a box of half-length 1 with corners rounded by a radius."""
    quarter = np.linspace(0, np.pi / 2, 200)
    arc = radius * np.column_stack([np.cos(quarter), np.sin(quarter)])
    x, y = 1 - radius, half_width - radius
    corners: Sequence[tuple[float, float]] = ((x, y), (-x, y), (-x, -y), (x, -y))
    return np.concatenate(
        [turned(arc, number * np.pi / 2) + corner for number, corner in enumerate(corners)]
    )


ROUNDNESS_CASE = Case(
    name="roundness",
    what="Wadell's roundness by size in pixels, on shapes whose roundness is known",
    run=roundness_by_size,
    smallest={"sizes_px": (30,), "charts": 1, "scenes": 1, "turns": 2},
)
