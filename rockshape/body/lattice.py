"""Directions spread evenly over the sphere."""

from functools import cache

import numpy as np

from rockshape.numerics.arrays import Floats

GOLDEN_RAD = np.pi * (1 + np.sqrt(5))


@cache
def spread_directions(count: int) -> Floats:
    """Unit vectors (count, 3), the first half of them with z > 0; the same array each time.

    Source: the Fibonacci lattice.
    """
    index = np.arange(count) + 0.5
    up = 1 - 2 * index / count
    level, turn = np.sqrt(1 - up * up), GOLDEN_RAD * index
    directions = np.column_stack([level * np.cos(turn), level * np.sin(turn), up])
    directions.setflags(write=False)
    return directions
