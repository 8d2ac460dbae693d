"""How true the everyday numbers of an outline are on closed forms by size, beside scikit-image.

    python benchmarks/descriptors.py

A disc, an ellipse 2:1 and a square drawn at each size (their longest extent), turned and shifted
anew eight times. Mean relative error and its standard deviation, in per cent.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipe
from silhouettes import REPORTED_FROM, fill, turned
from skimage.measure import regionprops

from rockshape.outline.descriptors import describe

SIZES = (10, 20, 30, 60, 100, 200, 500, 1000)
TURNS = 8
TURN = np.linspace(0, 2 * np.pi, 4000, endpoint=False)
CIRCLE = np.column_stack([np.cos(TURN), np.sin(TURN)]) / 2
SIDE = 1 / np.sqrt(2)
SQUARE = SIDE * np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])

# outlines whose greatest Feret diameter is 1, and their area, perimeter, least Feret diameter
FORMS = {
    "disc": (CIRCLE, np.pi / 4, np.pi, 1.0),
    "ellipse": (CIRCLE * (1, 0.5), np.pi / 8, 2 * ellipe(0.75), 0.5),
    "square": (SQUARE, SIDE**2, 4 * SIDE, SIDE),
}


def main() -> None:
    """Print the errors."""
    print("form     number              " + "".join(f"{size:>16d}" for size in SIZES))
    for name, (outline, area, perimeter, least) in FORMS.items():
        truth = {
            "area": lambda size, area=area: area * size**2,
            "perimeter": lambda size, perimeter=perimeter: perimeter * size,
            "feret_max": lambda size: size,
            "feret_min": lambda size, least=least: least * size,
            "circularity": lambda _, a=area, p=perimeter: 4 * np.pi * a / p**2,
            "solidity": lambda _: 1.0,
            "convexity": lambda _: 1.0,
        }
        masks = {size: [_drawn(outline * size, turn) for turn in range(TURNS)] for size in SIZES}
        for number, exact in truth.items():
            _tell(name, number, masks, exact, lambda mask, n=number: getattr(describe(mask), n))
        for number in ("perimeter", "perimeter_crofton", "feret_diameter_max", "solidity"):
            exact = truth[
                {"feret_diameter_max": "feret_max"}.get(number, number.removesuffix("_crofton"))
            ]
            _tell(
                name,
                f"skimage {number[:11]}",
                masks,
                exact,
                lambda mask, n=number: getattr(regionprops(mask.astype(np.uint8))[0], n),
            )


def _drawn(outline: NDArray[np.float64], turn: int) -> NDArray[np.bool_]:
    rng = np.random.default_rng(REPORTED_FROM + turn)
    return fill(turned(outline, rng.uniform(0, 7)) + rng.uniform(0, 1, 2))


def _tell(
    form: str,
    number: str,
    masks: dict[int, list[NDArray[np.bool_]]],
    exact: Callable[[float], float],
    read: Callable[[NDArray[np.bool_]], float],
) -> None:
    cells = []
    for size, drawn in masks.items():
        errors = 100 * (np.array([read(mask) for mask in drawn]) / exact(size) - 1)
        cells.append(f"  {errors.mean():+6.2f} ({errors.std():4.2f})")
    print(f"{form:8s} {number:19s} " + "".join(cells))


if __name__ == "__main__":
    main()
