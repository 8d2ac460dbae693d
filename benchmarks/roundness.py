"""How true Wadell's roundness is by size, on shapes whose roundness is known, beside fast_rs.

    python benchmarks/roundness.py [--charts 2]

Charts of 81 rounded polygons in Krumbein's manner, roundness 0.1 to 0.9 by oblong to square, seeds
from 10,000, each drawn at every size, turned and shifted anew; the outlines of rounded polyhedra,
which have some eleven corners; closed forms. fast_rs, which takes its roundness from local
thickness, is measured in the same run where it is installed.
"""

import argparse
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull
from silhouettes import REPORTED_FROM, draw, fill, turned

from rockshape.outline.edge import trace_edge
from rockshape.outline.resample import pixel_smooth
from rockshape.outline.roundness import wadell_roundness
from synth.rocks import quarry
from synth.rocks.outlines import RoundedHull
from synth.rocks.outlines.record import plane_across
from synth.spec.rocks import RocksSpec

try:
    import fast_rs.rs as fast_rs
except ImportError:
    fast_rs = None

SIZES = (30, 60, 100, 200, 500, 1000)
FAST_RS_UP_TO = 200  # pixels; its time grows with the square
TURNS = 8
Reader = Callable[[NDArray[np.bool_]], float]
Drawer = Callable[[float], NDArray[np.bool_]]  # the mask at a size
_TURNS = np.linspace(0, 2 * np.pi, 720, endpoint=False)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--charts", type=int, default=2)
    args = parser.parse_args()
    charts = [s for k in range(args.charts) for s in draw("krumbein", seed=REPORTED_FROM + k)]
    _compare(
        f"{len(charts)} rounded polygons",
        [(shape.mask, shape.truth()["roundness"]) for shape in charts],
        (0.31, 0.61),
    )
    rocks = _rocks(scenes=14)
    _compare(f"\n{len(rocks)} outlines of rounded polyhedra", rocks, (0.15, 0.3))
    print(f"\nclosed forms: mean and standard deviation over {TURNS} turns and shifts")
    print("form              truth " + "".join(f"{size:>14d}" for size in SIZES))
    for name, (outline, exact) in _closed_forms().items():
        cells = []
        for size in SIZES:
            rng = np.random.default_rng(REPORTED_FROM)
            found = [
                _read(fill(turned(outline * size / 2, rng.uniform(0, 7)) + rng.uniform(0, 1, 2)))
                for _ in range(TURNS)
            ]
            cells.append(f"  {np.mean(found):.3f} ({np.std(found):.3f})")
        print(f"{name:16s}  {exact:.3f} " + "".join(cells))


def _compare(
    title: str, shapes: Sequence[tuple[Drawer, float]], bounds: tuple[float, float]
) -> None:
    """Print what each reader makes of shapes at every size."""
    low, high = bounds
    truth = np.array([known for _, known in shapes])
    parts = [truth <= low, (truth > low) & (truth <= high), truth > high]
    print(title)
    print(f"reader       size      r    bias    rmse   bias of truth <= {low}, <= {high}, above")
    for name, reader in _readers().items():
        for size in SIZES:
            if name == "fast_rs" and size > FAST_RS_UP_TO:
                continue
            found = np.array([reader(drawer(size)) for drawer, _ in shapes])
            error = found - truth
            print(
                f"{name:10s} {size:6d} {np.corrcoef(truth, found)[0, 1]:6.3f} "
                f"{error.mean():+7.3f} {np.sqrt((error**2).mean()):7.3f}   "
                + "  ".join(f"{error[part].mean():+.3f}" for part in parts)
            )


def _rocks(*, scenes: int) -> list[tuple[Drawer, float]]:
    """Outlines of the rocks of suite ci's kind, each seen from anywhere, with their roundness."""
    found: list[tuple[Drawer, float]] = []
    for seed in range(REPORTED_FROM, REPORTED_FROM + scenes):
        rng = np.random.default_rng(seed)
        for rock in quarry(RocksSpec(), rng=rng):
            if not isinstance(rock.form, RoundedHull):
                continue
            across = plane_across(rng.normal(size=3))
            outline = _round_hull(rock.form.vertices_m @ across.T, rock.form.radius_m)
            known = rock.form.outline(across).roundness
            found.append((partial(_drawn, outline, int(rng.integers(2**31))), known))
    return found


def _round_hull(points: NDArray[np.float64], radius: float) -> NDArray[np.float64]:
    """The outline (n, 2) of all within a radius of the hull of points."""
    disc = radius * np.column_stack([np.cos(_TURNS), np.sin(_TURNS)])
    corners = points[ConvexHull(points).vertices]
    swollen = (corners[:, None] + disc).reshape(-1, 2)
    return np.asarray(swollen[ConvexHull(swollen).vertices])


def _drawn(outline: NDArray[np.float64], seed: int, size: float) -> NDArray[np.bool_]:
    rng = np.random.default_rng([seed, round(size)])
    turn, shift = rng.uniform(0, 2 * np.pi), rng.uniform(0, 1, 2)
    return fill(turned(outline * size / np.ptp(outline, axis=0).max(), turn) + shift)


def _readers() -> dict[str, Reader]:
    readers: dict[str, Reader] = {"rockshape": _read}
    if fast_rs is not None:
        readers["fast_rs"] = lambda mask: float(fast_rs.rs_calculate(mask)[0][0])
    return readers


def _read(mask: NDArray[np.bool_]) -> float:
    return wadell_roundness(pixel_smooth(trace_edge(mask)))


def _closed_forms() -> dict[str, tuple[NDArray[np.float64], float]]:
    """Outlines of half-length 1 and their roundness."""
    turns = np.linspace(0, 2 * np.pi, 4000, endpoint=False)
    circle = np.column_stack([np.cos(turns), np.sin(turns)])
    forms = {"disc": (circle, 1.0), "stadium 2:1": (_box(0.5, 0.5), 1.0)}
    for ratio in (0.9, 0.8, 0.6, 0.4):
        forms[f"ellipse {ratio}"] = (circle * (1, ratio), ratio)
    for radius in (0.05, 0.2, 0.5, 0.8):
        forms[f"square {radius}"] = (_box(1.0, radius), radius)
    for radius in (0.05, 0.2, 0.4):
        forms[f"2:1 box {radius}"] = (_box(0.5, radius), 2 * radius)
    return forms


def _box(half_width: float, radius: float) -> NDArray[np.float64]:
    """A box of half-length 1 with corners rounded by a radius."""
    turns = np.linspace(0, np.pi / 2, 200)
    arc = radius * np.column_stack([np.cos(turns), np.sin(turns)])
    x, y = 1 - radius, half_width - radius
    corners = ((x, y), (-x, y), (-x, -y), (x, -y))
    return np.concatenate(
        [turned(arc, quarter * np.pi / 2) + corner for quarter, corner in enumerate(corners)]
    )


if __name__ == "__main__":
    main()
