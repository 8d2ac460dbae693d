"""Label images that are pictures: masks whose edges were smoothed, or compressed with loss."""

from collections import Counter

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.strips import ROWS

MIN_LEVELS = 8  # numbers below which a label image may hold rocks that are all thin
FREE = 0.1  # of a rock's pixels touch no other rock, even where tiles of 3 px leave no ground
MOST_TOUCHING = 0.5  # of the numbers are less free than that in a label image


def grey_levels(labels: NDArray[np.integer]) -> str | None:
    """What shows that labels (rows, cols) are grey levels and no ids; None where nothing does.

    Levels of a smoothed edge or of noise lie beside other levels nearly everywhere, while rocks
    have pixels that touch no other rock: with eight numbers or more, half of them tell a picture.
    """
    area: Counter[int] = Counter()
    free: Counter[int] = Counter()
    for top in range(0, len(labels), ROWS):
        first = max(0, top - 1)
        strip = labels[first : top + ROWS + 1]
        inner = slice(top - first, top - first + ROWS)
        here, alone = strip[inner], ~_beside_another(strip)[inner]
        _count(area, here[here > 0])
        _count(free, here[(here > 0) & alone])
    touching = [number for number, count in area.items() if free[number] < FREE * count]
    if len(area) < MIN_LEVELS or len(touching) < MOST_TOUCHING * len(area):
        return None
    return (
        f"expected a number for each rock, found {len(area)} numbers of which {len(touching)} lie "
        f"along others alone, as grey levels of a smoothed or compressed mask do; "
        f"make it a mask of two values"
    )


def _count(counts: Counter[int], numbers: NDArray[np.integer]) -> None:
    found, count = np.unique(numbers, return_counts=True)
    counts.update(dict(zip(found.tolist(), count.tolist(), strict=True)))


def _beside_another(labels: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Pixels with a neighbour in their row or column of another number but 0."""
    found = np.zeros(labels.shape, dtype=np.bool_)
    across, down = _apart(labels[:, :-1], labels[:, 1:]), _apart(labels[:-1], labels[1:])
    found[:, :-1] |= across
    found[:, 1:] |= across
    found[:-1] |= down
    found[1:] |= down
    return found


def _apart(one: NDArray[np.integer], other: NDArray[np.integer]) -> NDArray[np.bool_]:
    return np.asarray((one != other) & (one > 0) & (other > 0))
