"""The least-squares ellipsoid of the points seen on a rock."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

FEWEST_POINTS = 30  # nine unknowns and some to spare
LARGEST = 3.0  # longest half-axis allowed, in sizes of the cloud: a flat face asks for infinity
SMALLEST = 0.02
SKETCH = 400  # points on which the starts compete, before all decide
MOST_STEPS = 500
SETTLED = 1e-10  # relative fall of the sum of squares at which a descent has converged
LEAST_DAMPING, MOST_DAMPING = 1e-12, 1e12
TINY = 1e-24
PROBE = 1e-5  # of the cloud's size: the step of differences between gradients
CREEPING = 1e-3  # relative fall of the sum of squares below which J^T J alone is too slow


@dataclass(frozen=True, eq=False)
class Ellipsoid:
    """An ellipsoid: p on it where |diag(1/half_axes) axes (p - centre)| = 1."""

    centre_m: NDArray[np.float64]  # (3,)
    half_axes_m: NDArray[np.float64]  # (3,), a >= b >= c
    axes: NDArray[np.float64]  # (3, 3), unit vectors in rows, in the order of half_axes_m

    def radial_distance_m(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Signed distances (n,) of points (n, 3), outside positive, along the ray from the centre.

        |p| (1 - 1/sqrt(q)) with p the vector from the centre and q its squared length in units of
        the half-axes. A point at the centre lies -c away.
        """
        own = (points_m - self.centre_m) @ self.axes.T
        length = np.linalg.norm(own, axis=1)
        level = np.linalg.norm(own / self.half_axes_m, axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = length * (1 - 1 / level)
        return np.asarray(np.where(level > 0, distance, -self.half_axes_m[2]))


@dataclass(frozen=True, eq=False)
class EllipsoidFit:
    """The ellipsoid found and how the search for it ended."""

    ellipsoid: Ellipsoid
    mean_square_m2: float  # D_S / N
    converged: bool
    bounded: bool  # an axis stands at the bound: the points do not determine it


@dataclass(frozen=True, eq=False)
class _State:
    centre: NDArray[np.float64]  # (3,)
    log_axes: NDArray[np.float64]  # (3,), unsorted
    rotation: NDArray[np.float64]  # (3, 3), own axes in columns


def fit_ellipsoid(points_m: NDArray[np.float64]) -> EllipsoidFit | None:
    """Ellipsoid of nine parameters that minimises D_S, the sum of squared radial distances.

    points_m is (n, 3) in the camera frame, the camera at the origin. Half-axes, centre and attitude
    are found by Levenberg-Marquardt descent with the analytic Jacobian. Several starts behind the
    visible surface compete on a sketch of 400 points, and the lowest descends on all; the paper
    descends the same D_S by Powell's method. A half-axis stays between 0.02 and 3 times the
    cloud's radius: a view of one side may not determine the rest, and a flat face would send an
    axis to infinity. `bounded` says so, and such axes are the bound's and not the rock's.

    None for fewer than 30 points, or where they have no extent in two directions.
    Source: Fox et al. (2002), equations 8 and 11; the axes are sorted after the fit.
    """
    if len(points_m) < FEWEST_POINTS:
        return None
    centroid = points_m.mean(axis=0)
    spread, directions = np.linalg.eigh(np.cov(points_m.T, bias=True))
    if spread[1] <= 1e-12 * spread[2] or spread[2] == 0:
        return None
    size = float(np.linalg.norm(points_m - centroid, axis=1).max())
    points = (points_m - centroid) / size
    bounds = (np.log(SMALLEST), np.log(LARGEST))
    # a fixed shuffle's first: every k-th in order would pick columns of the image
    sketch = points[np.random.default_rng(0).permutation(len(points))[:SKETCH]]
    starts = _starts(spread / size**2, directions, centroid / np.linalg.norm(centroid))
    nearest, *_ = min((_descend(sketch, start, bounds) for start in starts), key=lambda run: run[1])
    state, cost, converged = _descend(points, nearest, bounds)
    order = np.argsort(-state.log_axes, kind="stable")
    edge = 1e-9
    ellipsoid = Ellipsoid(
        centre_m=centroid + size * state.centre,
        half_axes_m=size * np.exp(state.log_axes[order]),
        axes=np.ascontiguousarray(state.rotation[:, order].T),
    )
    return EllipsoidFit(
        ellipsoid=ellipsoid,
        mean_square_m2=cost / len(points) * size**2,
        converged=converged,
        bounded=bool(
            state.log_axes.max() >= bounds[1] - edge or state.log_axes.min() <= bounds[0] + edge
        ),
    )


def _starts(
    spread: NDArray[np.float64], directions: NDArray[np.float64], view: NDArray[np.float64]
) -> list[_State]:
    """Centres at and behind the visible surface, with the cloud's own axes.

    A cap of a sphere seen from outside has its centre behind its centroid, so the starts move the
    centre along the view by none, a half and one standard length of the cloud.
    """
    deviations = np.sqrt(np.maximum(spread, 1e-6))
    axes = np.maximum(np.sqrt(3) * deviations, np.sqrt(3) * deviations[2] / 3)
    rotation = directions * np.sign(np.linalg.det(directions))
    return [
        _State(centre=back * deviations[2] * view, log_axes=np.log(axes), rotation=rotation)
        for back in (0.0, 0.5, 1.0)
    ]


def _residuals(state: _State, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Radial distances (n,) of points (n, 3)."""
    own = (points - state.centre) @ state.rotation
    length = np.sqrt(np.maximum(np.einsum("ij,ij->i", own, own), TINY))
    own *= np.exp(-state.log_axes)
    level = np.sqrt(np.maximum(np.einsum("ij,ij->i", own, own), TINY))
    return np.asarray(length * (1 - 1 / level))


def _jacobian(state: _State, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Derivatives (n, 9) of the distances by centre, log half-axes and own rotation.

    With y the point in the ellipsoid's own axes, v = y/s² and q = y . v:
    dq = -2 (R v) . dc - 2 (y v) . dlog s + 2 (v x y) . dw, for a rotation R exp([dw]x), and
    d(|p| (1 - q^-1/2)) = (1 - q^-1/2) d|p| + |p| q^-3/2 dq / 2.
    """
    offset = points - state.centre
    own = offset @ state.rotation
    length = np.sqrt(np.maximum(np.einsum("ij,ij->i", own, own), TINY))
    scaled = own * np.exp(-2 * state.log_axes)
    level = np.sqrt(np.maximum(np.einsum("ij,ij->i", own, scaled), TINY))
    weight = (length / level**3)[:, None]
    jacobian = np.empty((len(points), 9))
    jacobian[:, :3] = -((1 - 1 / level) / length)[:, None] * offset
    jacobian[:, :3] -= weight * (scaled @ state.rotation.T)
    jacobian[:, 3:6] = -weight * own * scaled
    jacobian[:, 6:] = weight * np.cross(scaled, own)
    return jacobian


def _descend(
    points: NDArray[np.float64], state: _State, bounds: tuple[float, float]
) -> tuple[_State, float, bool]:
    """Levenberg-Marquardt from one start, the log half-axes kept within bounds.

    Returns the state reached, its sum of squares and whether the descent converged. The damping
    follows Nielsen (1999): it falls by how well the last step was foreseen. On a rock that is no
    ellipsoid the residuals stay large and the Gauss-Newton matrix J^T J creeps, so that the whole
    Hessian takes over once a step gains less than a thousandth.
    """
    residual = _residuals(state, points)
    cost = float(residual @ residual)
    damping, growth = 1e-3, 2.0
    creeping = False
    for _ in range(MOST_STEPS):
        jacobian = _jacobian(state, points)
        normal, gradient = jacobian.T @ jacobian, jacobian.T @ residual
        free = _free(state, gradient, bounds)
        system = _hessian(state, points) if creeping else normal
        system, scale = system[np.ix_(free, free)], np.diag(normal)[free] + TINY
        while True:
            step = np.zeros(9)
            step[free] = -np.linalg.solve(system + np.diag(damping * scale), gradient[free])
            trial = _move(state, step, bounds)
            trial_residual = _residuals(trial, points)
            trial_cost = float(trial_residual @ trial_residual)
            if trial_cost < cost:
                break
            damping, growth = damping * growth, growth * 2
            if damping > MOST_DAMPING:
                return state, cost, True
        foreseen = float(step[free] @ (damping * scale * step[free] - gradient[free]))
        gain = (cost - trial_cost) / max(foreseen, TINY)
        damping = max(damping * max(1 / 3, 1 - (2 * gain - 1) ** 3), LEAST_DAMPING)
        growth = 2.0
        fall = cost - trial_cost
        state, residual, cost = trial, trial_residual, trial_cost
        if fall <= SETTLED * cost + TINY * len(points):
            return state, cost, True
        creeping = fall <= CREEPING * cost
    return state, cost, False


def _hessian(state: _State, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Half the Hessian (9, 9) of the sum of squares, by central differences of the gradient.

    Directions of negative curvature are turned round, so that every step leads downhill.
    """
    sides = []
    for nudge in PROBE * np.eye(9):
        ends = [_move(state, sign * nudge, (-np.inf, np.inf)) for sign in (1, -1)]
        up, down = (_jacobian(end, points).T @ _residuals(end, points) for end in ends)
        sides.append((up - down) / (2 * PROBE))
    values, vectors = np.linalg.eigh((np.array(sides) + np.array(sides).T) / 2)
    return np.asarray((vectors * np.abs(values)) @ vectors.T)


def _free(
    state: _State, gradient: NDArray[np.float64], bounds: tuple[float, float]
) -> NDArray[np.bool_]:
    """Parameters (9,) that may move: a half-axis pressed against its bound may not."""
    free = np.ones(9, dtype=bool)
    free[3:6] &= (state.log_axes < bounds[1]) | (gradient[3:6] > 0)
    free[3:6] &= (state.log_axes > bounds[0]) | (gradient[3:6] < 0)
    return free


def _move(state: _State, step: NDArray[np.float64], bounds: tuple[float, float]) -> _State:
    """The state a step (9,) leads to; no half-axis changes by more than a factor e at once."""
    return _State(
        centre=state.centre + step[:3],
        log_axes=np.clip(state.log_axes + np.clip(step[3:6], -1, 1), *bounds),
        rotation=state.rotation @ Rotation.from_rotvec(step[6:]).as_matrix(),
    )
