"""How much of the movement all rocks of a frame share: the systematic part the paper supposed."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.arrays import Floats
from validation.statistics.weighted import ratio

MIN_CELLS = 3


@dataclass(frozen=True, eq=False)
class Movements:
    """Pairs of rocks of one scene: how they move together from cell to cell, and each by itself."""

    first: NDArray[np.intp]  # (pairs,), index of a rock
    second: NDArray[np.intp]  # (pairs,)
    together: Floats  # (pairs,), covariance over the cells of value/mean
    alone: Floats  # (pairs,), mean of the two variances

    def shared(self, weights: Floats) -> Floats:
        """Σ w_i w_j cov_ij / Σ w_i w_j (var_i + var_j)/2 over pairs; NaN without movement.

        `weights` is (draws, rocks), the result (draws,).

        It is 1 where every frame multiplies all its rocks by one factor, which leaves each frame's
        order as it is, and 0 where each rock moves by itself.
        """
        own = weights[:, self.first] * weights[:, self.second]
        return ratio(own @ self.together, own @ self.alone)


def movements(values: Floats, *, rocks_a_scene: int) -> Movements:
    """Pairs of rocks of values (rocks, cells), over the cells in which both have one.

    A value is taken over the rock's mean in those cells; pairs of fewer than three cells, or with
    a mean that is not positive, are left out.
    """
    pairs: list[tuple[int, int, float, float]] = []
    for start in range(0, len(values), rocks_a_scene):
        scene = values[start : start + rocks_a_scene]
        for i, j in zip(*np.triu_indices(len(scene), 1), strict=True):
            both = scene[[i, j]][:, np.isfinite(scene[[i, j]]).all(axis=0)]
            if both.shape[1] < MIN_CELLS or (both.mean(axis=1) <= 0).any():
                continue
            moved = np.cov(both / both.mean(axis=1, keepdims=True), bias=True)
            pairs.append((start + int(i), start + int(j), moved[0, 1], np.trace(moved) / 2.0))
    table = np.array(pairs, dtype=np.float64).reshape(-1, 4)
    return Movements(
        first=table[:, 0].astype(np.intp),
        second=table[:, 1].astype(np.intp),
        together=table[:, 2],
        alone=table[:, 3],
    )
