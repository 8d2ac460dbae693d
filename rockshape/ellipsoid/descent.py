"""Damped descent to the least squares of an ellipsoid's nine parameters."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid.parameters import Bounds, State

MAX_STEPS = 500
SETTLED = 1e-10  # relative fall of the sum of squares at which a descent has converged
MIN_DAMPING, MAX_DAMPING = 1e-12, 1e12
TINY = 1e-24
FLATTEST = 1e-8  # curvature that counts as some, as a share of the largest
FIRST_DAMPING, NEAR_DAMPING = 1e-3, 1e-6
CREEPING = 0.1  # relative fall of the sum of squares below which J^T J alone is too slow


class Problem(Protocol):
    """A cost and its derivatives at a state."""

    def cost(self, state: State) -> float:
        """Half the sum of squares."""
        ...

    def derivatives(
        self, state: State, *, whole: bool
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Gradient (9,), and the Hessian (9, 9) of the cost or its Gauss-Newton part."""
        ...


@dataclass(frozen=True, eq=False)
class Descent:
    """Where a descent ended."""

    state: State
    cost: float
    converged: bool
    steps: int


def descend(
    problem: Problem,
    state: State,
    bounds: Bounds,
    *,
    enough: float = SETTLED,
    whole: bool | None = None,
) -> Descent:
    """Levenberg-Marquardt from one start, the log half-axes kept within bounds.

    The damping follows Nielsen (1999): it falls by how well the last step was foreseen. On a rock
    that is no ellipsoid the residuals stay large and the Gauss-Newton matrix J^T J creeps, so that
    the whole Hessian, its directions of negative curvature turned round, takes over once a step
    gains less than a tenth; or from the beginning with `whole`, for a start that is near. Converged
    where a step gains less than `enough` of the cost, or where no step, however short, gains
    anything.
    """
    cost = problem.cost(state)
    damping, growth = NEAR_DAMPING if whole else FIRST_DAMPING, 2.0
    creeping = bool(whole)
    for count in range(MAX_STEPS):
        gradient, system = problem.derivatives(state, whole=creeping)
        free = _free(state, gradient, bounds)
        system, gradient = system[free[:, None], free], gradient[free]
        scale = np.sqrt(
            np.abs(system.diagonal()) + FLATTEST * np.abs(system.diagonal()).max() + TINY
        )
        values, vectors = np.linalg.eigh(system / (scale[:, None] * scale))
        values = np.abs(values)
        downhill = vectors.T @ (gradient / scale)
        while True:
            inner = -downhill / (values + damping)
            step = np.zeros(9)
            step[free] = (vectors @ inner) / scale
            trial = state.moved(step, bounds)
            trial_cost = problem.cost(trial)
            if trial_cost < cost:
                break
            damping, growth = damping * growth, growth * 2
            if damping > MAX_DAMPING:
                return Descent(state, cost, True, count)
        foreseen = float(-(downhill @ inner) - 0.5 * (values * inner) @ inner)
        gain = (cost - trial_cost) / max(foreseen, TINY)
        damping = max(damping * max(0.1, 1 - (2 * gain - 1) ** 3), MIN_DAMPING)
        growth = 2.0
        fall = cost - trial_cost
        state, cost = trial, trial_cost
        if fall <= enough * cost + TINY:
            return Descent(state, cost, True, count + 1)
        creeping = fall <= CREEPING * cost if whole is None else whole
    return Descent(state, cost, False, MAX_STEPS)


_ALL = np.arange(9)


def _free(state: State, gradient: NDArray[np.float64], bounds: Bounds) -> NDArray[np.intp]:
    """Parameters that may move: a half-axis pressed against its bound may not."""
    low, high = state.log_axes <= bounds[0], state.log_axes >= bounds[1]
    held = (high & (gradient[3:6] <= 0)) | (low & (gradient[3:6] >= 0))
    if not held.any():
        return _ALL
    return np.flatnonzero(np.concatenate([[True] * 3, ~held, [True] * 3]))
