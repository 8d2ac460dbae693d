"""How the 2-D measures hold their value, and the order of shapes, from 30 to 1000 pixels.

    python benchmarks/resolution.py [--series 12]

Shapes of the series `roundness` and `sphericity`, seeds from 10,000, each drawn at every size,
turned and shifted anew. For each reading: Kendall's tau with the truth within a series, mean over
series, at each size; the same with all sizes in one heap, which only a measure free of resolution
passes (the truth repeats there, once a size, so that 0.924 is the most tau can be); and the mean
value at each size over that at 1000 px.
"""

import argparse
from collections.abc import Callable

import numpy as np
from scipy.stats import kendalltau
from silhouettes import REPORTED_FROM, draw

from rockshape.measures import (
    angularity_2d,
    axis_ratio,
    ellipse_error,
    roundness,
    sphericity_2d,
)
from rockshape.measures.measure import Measure
from rockshape.rock.view import RockView

SIZES = (30, 40, 60, 100, 200, 500, 1000)
COUNT = 6
QUESTIONS: tuple[tuple[str, str, tuple[tuple[str, Measure], ...]], ...] = (
    (
        "roundness",
        "roundness",
        (
            ("paper angularity_2d", angularity_2d.PAPER),
            ("robust angularity_2d", angularity_2d.ROBUST),
            ("paper ellipse_error", ellipse_error.PAPER),
            ("robust ellipse_error", ellipse_error.ROBUST),
            ("robust roundness", roundness.ROBUST),
        ),
    ),
    (
        "sphericity",
        "axis_ratio",
        (("paper axis_ratio", axis_ratio.PAPER), ("robust axis_ratio", axis_ratio.ROBUST)),
    ),
    (
        "sphericity",
        "rectangle_ratio",
        (
            ("paper sphericity_2d", sphericity_2d.PAPER),
            ("robust sphericity_2d", sphericity_2d.ROBUST),
        ),
    ),
)


def main() -> None:
    """Print a block for each question."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--series", type=int, default=12)
    args = parser.parse_args()
    for series, truth, readings in QUESTIONS:
        sets = [
            draw(series, seed=REPORTED_FROM + index, count=COUNT) for index in range(args.series)
        ]
        known = np.array([[shape.truth()[truth] for shape in shapes] for shapes in sets])
        views = {
            size: [[RockView(mask=shape.mask(size)) for shape in shapes] for shapes in sets]
            for size in SIZES
        }
        print(f"\nseries {series}, truth {truth}, {args.series} series of {COUNT} shapes")
        print("reading                what        " + "".join(f"{size:>8d}" for size in SIZES))
        for name, measure in readings:
            found = {
                size: np.array([[measure.read(view).value for view in row] for row in rows])
                for size, rows in views.items()
            }
            _tell(name, known, found)


def _tell(name: str, known: np.ndarray, found: dict[int, np.ndarray]) -> None:
    def line(what: str, number: Callable[[np.ndarray], float], form: str) -> None:
        print(f"{name:22s} {what:11s} " + "".join(f"{number(found[s]):{form}}" for s in SIZES))

    line("|tau|", lambda values: _tau(known, values), "8.3f")
    line("over 1000", lambda values: float(np.mean(values / found[SIZES[-1]])), "8.3f")
    everywhere = np.concatenate(list(found.values()), axis=1)
    heap = _tau(np.tile(known, len(SIZES)), everywhere)
    print(f"{name:22s} all sizes in one heap: |tau| {heap:.3f}")


def _tau(known: np.ndarray, values: np.ndarray) -> float:
    pairs = zip(known, values, strict=True)
    return abs(float(np.mean([kendalltau(*pair).statistic for pair in pairs])))


if __name__ == "__main__":
    main()
