"""Thinning of points: the mean of those in each cell of a cubic grid."""

import numpy as np
from numpy.typing import NDArray


def thinned(points_m: NDArray[np.float64], side_m: float, *, least: int = 1) -> NDArray[np.float64]:
    """Mean (k, 3) of the points (n, 3) in each cube of a side, of cubes with `least` or more."""
    if not len(points_m):
        return points_m
    cells = np.floor((points_m - points_m.min(axis=0)) / side_m).astype(np.int64)
    _, cell, count = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
    cell = cell.reshape(-1)
    sums = np.column_stack([np.bincount(cell, weights=axis) for axis in points_m.T])
    full = count >= least
    return np.asarray(sums[full] / count[full, None])
