"""Largest inscribed ball of a convex body given by half-spaces, in any dimension."""

from functools import lru_cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from synth.arrays import Floats

_MAX_TRIED = 4000  # sets of touching faces; beyond, linear programming is faster
_SLACK = 1e-10  # of the body's size: a face counts as respected
_SINGULAR = 1e-9


def largest_ball(normals: Floats, offsets_m: Floats) -> tuple[Floats, float]:
    """Largest ball, its centre (d,) and radius, in {x : n·x <= h}, n of length 1.

    It is the linear programme max ρ under n·x + ρ <= h, whose optimum is a vertex: some d + 1
    faces touch the ball. With few faces all such sets are solved at once and the best that
    respects the others is taken; with many a solver is asked. The centre need not be unique.
    """
    rows = np.column_stack([normals, np.ones(len(normals))])
    tried = _sets(len(rows), rows.shape[1])
    if tried is None:
        return _by_solver(rows, offsets_m)
    systems = rows[tried]
    regular = np.abs(np.linalg.det(systems)) > _SINGULAR
    found = np.linalg.solve(systems[regular], offsets_m[tried[regular]][..., None])[..., 0]
    size_m = float(np.abs(offsets_m).max())
    respected = (found @ rows.T <= offsets_m + _SLACK * size_m).all(axis=1)
    if not respected.any():
        return _by_solver(rows, offsets_m)
    best = found[respected][np.argmax(found[respected][:, -1])]
    return np.asarray(best[:-1]), float(best[-1])


@lru_cache(maxsize=32)
def _sets(faces: int, size: int) -> NDArray[np.int64] | None:
    """All sets of `size` faces, (k, size), or None if they are too many."""
    count = 1.0
    for step in range(size):
        count *= (faces - step) / (step + 1)
    if count > _MAX_TRIED or faces < size:
        return None
    sets = np.array(list(combinations(range(faces), size)))
    sets.setflags(write=False)
    return sets


def _by_solver(rows: Floats, offsets_m: Floats) -> tuple[Floats, float]:
    free = rows.shape[1] - 1
    found = linprog(
        [0.0] * free + [-1.0],
        A_ub=rows,
        b_ub=offsets_m,
        bounds=[(None, None)] * free + [(0, None)],
    )
    return np.asarray(found.x[:-1]), float(found.x[-1])
