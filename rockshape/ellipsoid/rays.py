"""How far an ellipsoid's silhouette and its lowest point lie from where they should."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid.state import State

TINY = 1e-24


@dataclass(frozen=True, eq=False)
class Linearised:
    """Residuals (n,) and their derivatives (9, n) by the parameters of a step."""

    residuals: NDArray[np.float64]
    jacobian: NDArray[np.float64]


def points_to_surface(points: NDArray[np.float64], state: State) -> Linearised:
    """Radial distances of points (3, n), outside positive: |y| (1 - 1/v), v = |y/s|."""
    own = state.rotation.T @ (points - state.centre[:, None])
    return _radial(own, state)


def _radial(own: NDArray[np.float64], state: State) -> Linearised:
    inverse = np.exp(-2 * state.log_axes)
    length = np.sqrt(np.maximum((own * own).sum(axis=0), TINY))
    level = np.sqrt(np.maximum(inverse @ (own * own), TINY))
    share = 1 - 1 / level
    weight = length / level**3
    jacobian = np.empty((9, own.shape[1]))
    scaled = inverse[:, None] * own
    jacobian[:3] = -(share / length) * own - weight * scaled
    jacobian[3:6] = -weight * own * scaled
    jacobian[6:] = weight * cross(scaled, own)
    return Linearised(residuals=length * share, jacobian=jacobian)


def rays_to_silhouette(
    directions: NDArray[np.float64], origin: NDArray[np.float64], state: State
) -> Linearised:
    """Radial distances of rays from an ellipsoid, outside positive; 0 for a tangent.

    directions (3, n) from origin (3,). The distance is that of the ray's point of the lowest
    level v = |y/s|, at t = -(β . α)/(β . β) with β = d/s and α = (origin - centre)/s in own axes.
    """
    scale = np.exp(-state.log_axes)[:, None]
    aim = state.rotation.T @ directions
    start = (state.rotation.T @ (origin - state.centre))[:, None]
    beta, alpha = scale * aim, scale * start
    square = (beta * beta).sum(axis=0)
    along = -(beta * alpha).sum(axis=0) / square
    own = start + along * aim
    result = _radial(own, state)
    length = np.sqrt(np.maximum((own * own).sum(axis=0), TINY))
    # the foot moves along the ray: v is stationary there, |y| is not
    slide = (result.residuals / length) * (own * aim).sum(axis=0) / length
    foot = alpha + along * beta  # the foot over the half-axes
    moved = np.empty_like(result.jacobian)
    moved[:3] = scale * beta
    moved[3:6] = 2 * beta * foot
    turned = alpha + 2 * along * beta
    moved[6:] = -cross(scale * beta, start) - cross(scale * turned, aim)
    return Linearised(residuals=result.residuals, jacobian=result.jacobian + slide * moved / square)


def lowest_point(normal: NDArray[np.float64], state: State) -> Linearised:
    """Height of the lowest point over the plane through 0: n . c - |(s_k a_k . n)|, one residual.

    dh = n . dc - (r_k²/|r|) dlog s_k - ..., with r_k = s_k (a_k . n).
    """
    own = state.rotation.T @ normal
    square = np.exp(2 * state.log_axes)
    reach = float(np.sqrt(square @ (own * own)))
    jacobian = np.empty((9, 1))
    jacobian[:3, 0] = own
    jacobian[3:6, 0] = -square * own * own / reach
    # R exp([w]): own -> own - w x own
    jacobian[6:, 0] = np.cross(own, square * own / reach)
    return Linearised(residuals=np.array([float(normal @ state.centre) - reach]), jacobian=jacobian)


def cross(first: NDArray[np.float64], second: NDArray[np.float64]) -> NDArray[np.float64]:
    """Cross products (3, n) of columns; numpy's own spends its time on the order of axes."""
    (a, b, c), (x, y, z) = first, second
    return np.stack([b * z - c * y, c * x - a * z, a * y - b * x])
