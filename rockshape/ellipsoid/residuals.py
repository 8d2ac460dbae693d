"""How far an ellipsoid's silhouette and its lowest point lie from where they should."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rockshape.ellipsoid.parameters import State
from rockshape.numerics.arrays import Floats

TINY = 1e-24
_NEXT, _LAST = np.array([1, 2, 0]), np.array([2, 0, 1])


@dataclass(frozen=True, eq=False)
class Linearised:
    """Residuals (n,), and their derivatives (9, n) by the parameters of a step if asked for."""

    residuals: Floats
    derive: Callable[[], Floats]

    @cached_property
    def jacobian(self) -> Floats:
        """The derivatives; a search asks for them where it steps, not at every trial."""
        return self.derive()


def points_to_surface(points: Floats, state: State) -> Linearised:
    """Radial distances of points (3, n), outside positive: |y| (1 - 1/v), v = |y/s|."""
    return _radial(state.rotation.T @ (points - state.centre[:, None]), state)


def _radial(own: Floats, state: State) -> Linearised:
    inverse = np.exp(-2 * state.log_axes)
    both = np.stack([np.ones(3), inverse]) @ (own * own)
    length, level = np.sqrt(np.maximum(both, TINY))
    share = 1 - 1 / level

    def derive() -> Floats:
        weight = length / (level * level * level)
        jacobian = np.empty((9, own.shape[1]))
        heavy = inverse[:, None] * own
        heavy *= weight
        np.multiply(-(share / length), own, out=jacobian[:3])
        jacobian[:3] -= heavy
        np.multiply(-own, heavy, out=jacobian[3:6])
        np.multiply(weight, _twisted(own, inverse), out=jacobian[6:])
        return jacobian

    return Linearised(residuals=length * share, derive=derive)


def rays_to_silhouette(directions: Floats, origin: Floats, state: State) -> Linearised:
    """Radial distances of rays from an ellipsoid, outside positive; 0 for a tangent.

    directions (3, n) from origin (3,). The distance is that of the ray's point of the lowest
    level v = |y/s|, at t = -(β . α)/(β . β) with β = d/s and α = (origin - centre)/s in own axes.
    """
    scale = np.exp(-state.log_axes)
    aim = state.rotation.T @ directions
    start = state.rotation.T @ (origin - state.centre)
    beta, alpha = scale[:, None] * aim, scale * start
    square = (beta * beta).sum(axis=0)
    along = -(alpha @ beta) / square
    own = start[:, None] + along * aim
    found = _radial(own, state)

    def derive() -> Floats:
        # the foot moves along the ray: v is stationary there, |y| is not
        reached = np.maximum((own * own).sum(axis=0), TINY)
        slide = found.residuals * (own * aim).sum(axis=0) / (reached * square)
        inverse = scale * scale
        moved = np.empty((9, own.shape[1]))
        np.multiply(inverse[:, None], aim, out=moved[:3])
        np.multiply(2 * beta, alpha[:, None] + along * beta, out=moved[3:6])
        # start x D aim - (D start + 2 along D aim) x aim, with D = diag(1/s²)
        np.matmul(_crossing(start) * inverse - _crossing(inverse * start), aim, out=moved[6:])
        moved[6:] -= 2 * along * _twisted(aim, inverse)
        moved *= slide
        moved += found.jacobian
        return moved

    return Linearised(residuals=found.residuals, derive=derive)


def lowest_point(normal: Floats, state: State) -> Linearised:
    """Height of the lowest point over the plane through 0: n . c - |(s_k a_k . n)|, one residual.

    dh = n . dc - (r_k²/|r|) dlog s_k - ..., with r_k = s_k (a_k . n).
    """
    own = state.rotation.T @ normal
    square = np.exp(2 * state.log_axes)
    reach = float(np.sqrt(square @ (own * own)))

    def derive() -> Floats:
        jacobian = np.empty((9, 1))
        jacobian[:3, 0] = own
        jacobian[3:6, 0] = -square * own * own / reach
        # R exp([w]): own -> own - w x own
        jacobian[6:, 0] = _crossing(own) @ (square * own / reach)
        return jacobian

    return Linearised(residuals=np.array([float(normal @ state.centre) - reach]), derive=derive)


def _twisted(own: Floats, inverse: Floats) -> Floats:
    """Cross products D y x y (3, n) of columns y with D = diag(inverse)."""
    return np.asarray((inverse[_NEXT] - inverse[_LAST])[:, None] * own[_NEXT] * own[_LAST])


def _crossing(vector: Floats) -> Floats:
    """The matrix (3, 3) that takes y to vector x y."""
    x, y, z = vector.tolist()
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
