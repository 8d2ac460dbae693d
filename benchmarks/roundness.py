"""How true Wadell's roundness is by size, on shapes whose roundness is known, beside fast_rs.

    python benchmarks/roundness.py [--charts 2]

Charts of 81 rounded polygons in Krumbein's manner, roundness 0.1 to 0.9 by oblong to square, seeds
from 10,000, each drawn at every size, turned and shifted anew. Then closed forms. fast_rs, which
takes its roundness from local thickness, is measured in the same run where it is installed.
"""

import argparse
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from silhouettes import REPORTED_FROM, draw, fill, turned

from rockshape.outline_edge import trace_edge
from rockshape.outline_even import pixel_smooth
from rockshape.roundness import wadell_roundness

try:
    import fast_rs.rs as fast_rs
except ImportError:
    fast_rs = None

SIZES = (30, 60, 100, 200, 500, 1000)
FAST_RS_UP_TO = 200  # pixels; its time grows with the square
TURNS = 8
Reader = Callable[[NDArray[np.bool_]], float]


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--charts", type=int, default=2)
    args = parser.parse_args()
    shapes = [s for k in range(args.charts) for s in draw("krumbein", seed=REPORTED_FROM + k)]
    truth = np.array([shape.truth()["roundness"] for shape in shapes])
    print(f"{len(shapes)} rounded polygons")
    print("reader       size      r    bias    rmse   bias of truth <= 0.3, to 0.6, above")
    for name, reader in _readers().items():
        for size in SIZES:
            if name == "fast_rs" and size > FAST_RS_UP_TO:
                continue
            found = np.array([reader(shape.mask(size)) for shape in shapes])
            error = found - truth
            parts = [truth <= 0.31, (truth > 0.31) & (truth < 0.61), truth >= 0.61]
            print(
                f"{name:10s} {size:6d} {np.corrcoef(truth, found)[0, 1]:6.3f} "
                f"{error.mean():+7.3f} {np.sqrt((error**2).mean()):7.3f}   "
                + "  ".join(f"{error[part].mean():+.3f}" for part in parts)
            )
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
