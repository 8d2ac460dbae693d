"""D_S, the sum of squared radial distances of points from an ellipsoid, and its derivatives."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid.parameters import State

TINY = 1e-24
CHUNK = 1000  # points at a time: their products stay in the cache

# generators of the rotations about own x, y and z
_TURNS = np.zeros((3, 3, 3))
_TURNS[[0, 1, 2], [2, 0, 1], [1, 2, 0]] = 1
_TURNS[[0, 1, 2], [1, 2, 0], [2, 0, 1]] = -1
_TWICE = np.einsum("iab,jbc->ijac", _TURNS, _TURNS)
_TWICE = (_TWICE + _TWICE.transpose(1, 0, 2, 3)) / 2

_NEXT, _LAST = np.array([1, 2, 0]), np.array([2, 0, 1])
_CENTRE, _AXES = np.arange(3), np.arange(3, 6)


@dataclass(frozen=True, eq=False)
class Radial:
    """Half the weighted sum of squared radial distances as a function of the nine parameters."""

    points: NDArray[np.float64]  # (3, n)
    weights: NDArray[np.float64] | None = None  # (n,), 1 where None

    def residuals(self, state: State) -> NDArray[np.float64]:
        """Radial distances (n,): |p| (1 - 1/sqrt(q)), p from the centre, q = Σ (p_k/s_k)²."""
        own = state.rotation.T @ (self.points - state.centre[:, None])
        square = own * own
        length = np.sqrt(np.maximum(square.sum(axis=0), TINY))
        level = np.sqrt(np.maximum(np.exp(-2 * state.log_axes) @ square, TINY))
        return np.asarray(length - length / level)

    def cost(self, state: State) -> float:
        """Half the weighted sum of squares."""
        residual = self.residuals(state)
        weighted = residual if self.weights is None else self.weights * residual
        return 0.5 * float(residual @ weighted)

    def derivatives(
        self, state: State, *, whole: bool
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Gradient (9,), and the Hessian (9, 9) of the cost or its Gauss-Newton part J^T J.

        In own axes, with y the point, D = diag(1/s²), q = y^T D y and l = |y|, the distance is
        e = l (1 - q^-1/2), so that
        de = (1 - q^-1/2) dl + l q^-3/2 dq / 2,
        d²e = (1 - q^-1/2) d²l + q^-3/2 (dl dq + dq dl)/2 - 3/4 l q^-5/2 dq dq + l q^-3/2 d²q / 2,
        where q depends on the attitude through exp([w]) D exp(-[w]). The Hessian adds the sum of
        e d²e to the Gauss-Newton matrix. As dl = -y/l, and dq is made of the nine products of
        y alone, every sum is a moment of those products.
        """
        inverse = np.exp(-2 * state.log_axes)
        turned = inverse[_NEXT] - inverse[_LAST]
        slopes = np.concatenate([-2 * inverse, -2 * inverse, 2 * turned])  # of q by the products
        total = _Moments()
        for start in range(0, self.points.shape[1], CHUNK):
            here = slice(start, start + CHUNK)
            weights = None if self.weights is None else self.weights[here]
            total.add(self.points[:, here], weights, state, inverse, whole=whole)
        gradient = slopes * total.level_side
        gradient[:3] -= total.length_side
        system = total.level_level * (slopes[:, None] * slopes)
        across = total.length_level * slopes
        system[:3] += across
        system[:, :3] += across.T
        system[:3, :3] += total.length_length
        if whole:
            system[_CENTRE, _CENTRE] += total.bulge
            system += _level_bends(total.bend, total.bend_first, total.bend_second, inverse)
        return gradient, system


class _Moments:
    """Sums over points of products of coordinates, with weights from the residuals.

    The products are x, y, z, x², y², z², yz, zx, xy in own axes.
    """

    def __init__(self) -> None:
        """Start from nothing."""
        self.level_side = np.zeros(9)  # (9,), of the products, for the gradient by q
        self.length_side = np.zeros(3)  # (3,), of the coordinates, by l
        self.level_level = np.zeros((9, 9))  # (9, 9)
        self.length_level = np.zeros((3, 9))  # (3, 9)
        self.length_length = np.zeros((3, 3))  # (3, 3)
        self.bulge = 0.0
        self.bend = 0.0
        self.bend_first = np.zeros(3)  # (3,)
        self.bend_second = np.zeros((3, 3))  # (3, 3)

    def add(
        self,
        points: NDArray[np.float64],
        weights: NDArray[np.float64] | None,
        state: State,
        inverse: NDArray[np.float64],
        *,
        whole: bool,
    ) -> None:
        """Add points (3, n)."""
        own = state.rotation.T @ (points - state.centre[:, None])
        products = np.empty((9, own.shape[1]))
        products[:3] = own
        np.multiply(own, own, out=products[3:6])
        np.multiply(own[1], own[2], out=products[6])
        np.multiply(own[2], own[0], out=products[7])
        np.multiply(own[0], own[1], out=products[8])
        square = np.maximum(products[3:6].sum(axis=0), TINY)
        level = np.maximum(inverse @ products[3:6], TINY)
        length, root = np.sqrt(square), np.sqrt(level)
        cube = 1 / (level * root)
        short = 1 - 1 / root  # 1 - q^-1/2
        by_level = 0.5 * length * cube
        by_length = short / length
        residual = length * short
        both, mixed, straight = by_level * by_level, -by_level * by_length, by_length * by_length
        if whole:
            both -= 1.5 * residual * by_level / level
            mixed -= 0.5 * short * cube
            straight -= short * short / square
        if weights is not None:
            both, mixed, straight = weights * both, weights * mixed, weights * straight
            residual = weights * residual
        bend = residual * by_level
        self.level_side += products @ bend
        self.length_side += own @ (residual * by_length)
        self.level_level += (products * both) @ products.T
        self.length_level += (own * mixed) @ products.T
        self.length_length += (own * straight) @ own.T
        if whole:
            self.bulge += float((residual * by_length).sum())
            self.bend += float(bend.sum())
            self.bend_first += own @ bend
            self.bend_second += (own * bend) @ own.T


def _level_bends(
    total: float,
    first: NDArray[np.float64],
    second: NDArray[np.float64],
    inverse: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Weighted sum of the second derivatives (9, 9) of q, from the weighted moments of y.

    total is Σ w, first (3,) Σ w y and second (3, 3) Σ w y y^T.
    """
    bends = np.zeros((9, 9))
    bends[_CENTRE, _CENTRE] = 2 * total * inverse
    bends[_CENTRE, _AXES] = bends[_AXES, _CENTRE] = 4 * inverse * first
    bends[_AXES, _AXES] = 4 * inverse * second.diagonal()
    # K D - D K for each rotation, the slope of the form by it
    turned = _TURNS * (inverse - inverse[:, None])
    bends[6:, :3] = -2 * (turned @ first)
    bends[:3, 6:] = bends[6:, :3].T
    bends[6:, 3:6] = -4 * inverse * (_TURNS * second.T).sum(axis=1)
    bends[3:6, 6:] = bends[6:, 3:6].T
    # K_i K_j D + D K_i K_j - K_i D K_j - K_j D K_i, made even in i and j
    across = (_TURNS * inverse)[:, None] @ _TURNS
    curved = _TWICE * (inverse + inverse[:, None]) - across - across.transpose(1, 0, 2, 3)
    bends[6:, 6:] = (curved * second).sum(axis=(2, 3))
    return bends
