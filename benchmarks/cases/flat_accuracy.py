"""2-D measures by size in pixels: descriptors, and the order of shapes."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from case import Case, Column, Table
from scipy.special import ellipe
from scipy.stats import kendalltau
from silhouettes import CIRCLE, REPORTED_FROM, Floats, Mask, draw, over_turns
from skimage.measure import regionprops

from rockshape.measures import angularity_2d, axis_ratio, ellipse_error, roundness, sphericity_2d
from rockshape.outline.descriptors import describe
from rockshape.rock.view import RockView

try:
    import fast_rs.rs as fast_rs
except ImportError:
    fast_rs = None


Reader = Callable[[Mask], float]


ORDERS = (
    ("roundness", "roundness", (angularity_2d, ellipse_error, roundness)),
    ("sphericity", "axis_ratio", (axis_ratio,)),
    ("sphericity", "rectangle_ratio", (sphericity_2d,)),
)


def descriptors_by_size(
    *, sizes_px: tuple[int, ...] = (10, 20, 30, 60, 100, 200, 500, 1000), turns: int = 8
) -> list[Table]:
    """Return the relative error of descriptors on closed forms, ours and scikit-image's."""
    side = 1 / np.sqrt(2)
    square = side * np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    # outlines whose greatest Feret diameter is 1, and their area, perimeter, least Feret diameter
    forms = {
        "disc": (CIRCLE / 2, np.pi / 4, np.pi, 1.0),
        "ellipse 2:1": (CIRCLE / 2 * (1, 0.5), np.pi / 8, 2 * ellipe(0.75), 0.5),
        "square": (square, side**2, 4 * side, side),
    }
    theirs = {
        "perimeter": "perimeter",
        "perimeter_crofton": "perimeter",
        "feret_diameter_max": "feret_max",
        "solidity": "solidity",
    }
    rows = []
    for form, (outline, area, perimeter, least) in forms.items():
        # the exact value at size 1 and its power of the size
        exact = {
            "area": (area, 2),
            "perimeter": (perimeter, 1),
            "feret_max": (1.0, 1),
            "feret_min": (least, 1),
            "circularity": (4 * np.pi * area / perimeter**2, 0),
            "solidity": (1.0, 0),
            "convexity": (1.0, 0),
        }
        readers: list[tuple[str, str, Reader]] = [
            ("rockshape", name, lambda mask, n=name: getattr(describe(mask), n)) for name in exact
        ]
        readers += [("skimage", name, partial(_skimage, name=name)) for name in theirs]
        for by, name, reader in readers:
            value, power = exact[theirs.get(name, name) if by == "skimage" else name]
            errors = [
                100 * (over_turns(reader, outline * size, turns) / (value * size**power) - 1)
                for size in sizes_px
            ]
            rows.append((form, name, by, *(f"{e.mean():+.1f} ± {e.std():.1f}" for e in errors)))
    heads = [Column(f"{size} px", "%") for size in sizes_px]
    return [Table((Column("form"), Column("descriptor"), Column("by"), *heads), rows)]


def order_by_size(
    *, sizes_px: tuple[int, ...] = (30, 40, 60, 100, 200, 500, 1000), series: int = 12
) -> list[Table]:
    """Return how the 2-D measures keep the order of six shapes, and their value, at every size.

    The truth repeats in the column of all sizes, once a size, so that 0.924 is the most that |τ|
    can be there with seven sizes; a measure free of resolution comes near it.
    """
    orders, levels = [], []
    for kind, truth, modules in ORDERS:
        sets = [draw(kind, seed=REPORTED_FROM + index, count=6) for index in range(series)]
        known = np.array([[shape.truth()[truth] for shape in shapes] for shapes in sets])
        views = [
            [[RockView(mask=shape.mask(size)) for shape in shapes] for shapes in sets]
            for size in sizes_px
        ]
        measures = [m for module in modules for m in _readings(module)]
        for method, measure in measures:
            found = [
                np.array([[measure.read(view).value for view in row] for row in rows])
                for rows in views
            ]
            head = (f"`{measure.column}`", method)
            heap = _tau(np.tile(known, len(sizes_px)), np.concatenate(found, axis=1))
            orders.append((*head, *(_tau(known, values) for values in found), heap))
            levels.append((*head, *(float(np.mean(values / found[-1])) for values in found)))
    head = (Column("measure"), Column("method"))
    sized = [Column(f"{size} px", "", ".3f") for size in sizes_px]
    return [
        Table((*head, *sized, Column("all sizes", "", ".3f")), orders, name="order"),
        Table((*head, *sized), levels, name="level"),
    ]


def _readings(module: Any) -> list[tuple[str, Any]]:
    """Return the measure of each method that has it."""
    pairs = (("paper", "PAPER"), ("robust", "ROBUST"))
    return [(method, getattr(module, name)) for method, name in pairs if hasattr(module, name)]


def _tau(known: Floats, values: Floats) -> float:
    """Return the size of the mean over series of Kendall's tau."""
    pairs = zip(known, values, strict=True)
    return abs(float(np.mean([kendalltau(*pair).statistic for pair in pairs])))


def _skimage(mask: Mask, *, name: str) -> float:
    return float(getattr(regionprops(mask.astype(np.uint8))[0], name))


DESCRIPTORS_CASE = Case(
    name="descriptors",
    what="relative error of outline descriptors by greatest extent, on closed forms",
    run=descriptors_by_size,
    smallest={"sizes_px": (10,), "turns": 2},
)

RESOLUTION_CASE = Case(
    name="resolution",
    what="|τ| with the truth in series of six shapes, and mean value over that at 1000 px",
    run=order_by_size,
    smallest={"sizes_px": (30, 40), "series": 2},
)
