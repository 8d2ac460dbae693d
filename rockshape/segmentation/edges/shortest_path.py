"""The cheapest path along many bands at once, by dynamic programming."""

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Singles


def cheapest_paths(cost: Singles, *, bend: NDArray[np.float32]) -> NDArray[np.intp]:
    """The lane of each step on the cheapest path along each band, (bands, steps).

    cost is (bands, steps, lanes); a path moves by at most one lane a step, which costs bend
    (bands,) each time.
    """
    bands, steps, lanes = cost.shape
    price = np.asarray(bend, dtype=np.float32)[:, None]
    best = cost[:, 0].copy()
    moves = np.zeros((bands, steps, lanes), dtype=np.int8)
    for step in range(1, steps):
        choice = np.zeros((bands, lanes), dtype=np.int8)
        least = best.copy()
        from_below = best[:, :-1] + price
        better = from_below < least[:, 1:]
        least[:, 1:][better] = from_below[better]
        choice[:, 1:][better] = -1
        from_above = best[:, 1:] + price
        better = from_above < least[:, :-1]
        least[:, :-1][better] = from_above[better]
        choice[:, :-1][better] = 1
        moves[:, step] = choice
        best = least + cost[:, step]
    lane = best.argmin(axis=1)
    rows = np.arange(bands)
    path = np.empty((bands, steps), dtype=np.intp)
    for step in range(steps - 1, -1, -1):
        path[:, step] = lane
        lane = lane + moves[rows, step, lane]
    return path


def closed_paths(
    cost: list[Singles], *, bend: NDArray[np.float32], overlap: int
) -> list[NDArray[np.intp]]:
    """The lane of each step on the cheapest closed path round each ring.

    cost has a ring's (steps, lanes) for each; rings differ in steps. Each ring is run round with
    `overlap` steps before and behind, which close it but for rare ties.
    """
    longest = max((len(ring) for ring in cost), default=0)
    if longest == 0:
        return []
    around = np.arange(-overlap, longest + overlap)
    bands = np.stack([ring[around % len(ring)] for ring in cost])
    paths = cheapest_paths(bands, bend=bend)
    return [path[overlap : overlap + len(ring)] for path, ring in zip(paths, cost, strict=True)]
