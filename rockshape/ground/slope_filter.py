"""What lies under heights and is nowhere steeper than ground can be."""

import numpy as np

from rockshape.numerics.arrays import Floats

MAX_ROUNDS = 100  # cells across the widest rock


def gentle_below(height_m: Floats, rise_m: Floats) -> Floats:
    """The highest surface below heights that rises at most so much from a cell to the next.

    g(x) = min over y of h(y) + the rise along the way from y to x. height_m is (rows, cols),
    infinite where nothing is known; rise_m (rows, cols), or what broadcasts to it, is the most from
    a cell to the next in its row or column, sqrt(2) of it to the next across. Where the ground is
    less steep than that it is its own envelope, crest and trough alike; what is steeper stands
    above it.
    """
    below = height_m
    for _ in range(MAX_ROUNDS):
        padded = np.pad(below, 1, constant_values=np.inf)
        up, middle, down = padded[:-2], padded[1:-1], padded[2:]
        beside = np.minimum(
            np.minimum(up[:, 1:-1], down[:, 1:-1]), np.minimum(middle[:, :-2], middle[:, 2:])
        )
        across = np.minimum(
            np.minimum(up[:, :-2], down[:, :-2]), np.minimum(up[:, 2:], down[:, 2:])
        )
        reached = np.minimum(beside + rise_m, across + np.sqrt(2) * rise_m)
        if not (reached < below).any():
            break
        below = np.minimum(below, reached)
    return below
