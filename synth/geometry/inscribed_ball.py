"""Largest inscribed ball of a convex body given by half-spaces, in any dimension."""

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from synth.arrays import Floats

_MAX_TRIED = 4000  # sets of touching faces; beyond, linear programming is faster
_SLACK = 1e-10  # of the body's size: a face counts as respected
_SINGULAR = 1e-9
_PULL, _ROOM = 1e-2, 1e-3  # least dual of a face that holds the ball; least room to others, of size


@dataclass(frozen=True, eq=False)
class InscribedBall:
    """Largest ball in a body."""

    centre_m: Floats  # (d,)
    radius_m: float
    touching: NDArray[np.int64] | None  # the d + 1 faces that hold it, if they are known


def largest_ball(
    normals: Floats, offsets_m: Floats, *, likely: NDArray[np.int64] | None = None
) -> InscribedBall:
    """Largest ball in {x : n·x <= h}, n of length 1.

    It is the linear programme max ρ under n·x + ρ <= h, whose optimum is a vertex: some d + 1
    faces touch the ball. With few faces all such sets are solved at once and the best that
    respects the others is taken; with many a solver is asked. The centre need not be unique.
    `likely` are the faces that touch it in a similar body; they are tried first.
    """
    rows = np.column_stack([normals, np.ones(len(normals))])
    if likely is not None:
        held = _held_by(rows, offsets_m, likely)
        if held is not None:
            return held
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
    among = np.flatnonzero(respected)
    best = among[np.argmax(found[respected][:, -1])]
    return _ball(found[best], tried[regular][best])


def _held_by(rows: Floats, offsets_m: Floats, faces: NDArray[np.int64]) -> InscribedBall | None:
    """Ball that touches some faces, if it is clear that no other ball is as large.

    The faces hold it when the programme's dual is positive; it must be so by a margin, and so must
    the room to all other faces, so that rounding cannot let another set of faces win.
    """
    system: Floats = rows[faces]
    pull = np.linalg.solve(system.T, np.eye(len(faces))[-1])
    if not pull.min() > _PULL:
        return None
    found = np.asarray(np.linalg.solve(system, offsets_m[faces][:, None])[:, 0], dtype=np.float64)
    room_m = offsets_m - rows @ found
    room_m[faces] = np.inf
    clear = room_m.min() > _ROOM * float(np.abs(offsets_m).max())
    return _ball(found, faces) if clear else None


def _ball(found: Floats, touching: NDArray[np.int64] | None) -> InscribedBall:
    return InscribedBall(np.asarray(found[:-1]), float(found[-1]), touching)


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


def _by_solver(rows: Floats, offsets_m: Floats) -> InscribedBall:
    free = rows.shape[1] - 1
    found = linprog(
        [0.0] * free + [-1.0],
        A_ub=rows,
        b_ub=offsets_m,
        bounds=[(None, None)] * free + [(0, None)],
    )
    return _ball(found.x, None)
