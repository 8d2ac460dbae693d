"""Greatest width of points."""

import numpy as np

from rockshape.body.lattice import spread_directions
from rockshape.numerics.arrays import Floats

DIRECTIONS = 400  # half of them opposite to the others; too small by 1 % at most


def greatest_width_m(points_m: Floats) -> float:
    """Greatest extent of points (n, 3) along 200 directions spread over all; 0 without points."""
    if len(points_m) == 0:
        return 0.0
    return float(
        np.ptp(spread_directions(DIRECTIONS)[: DIRECTIONS // 2] @ points_m.T, axis=1).max()
    )
