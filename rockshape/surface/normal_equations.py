"""The normal equations of a B-spline surface in banded form."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rockshape.surface.basis import Basis, Knots, derivative_net, overlaps

BUNCH = 16  # data of one cell that are multiplied at a time
CHUNK = 4096  # data whose products stay in the cache
MIN_PIVOT = 1e-13  # of the largest: below it rounding decides what the data do not


@dataclass(frozen=True)
class Net:
    """The polygon net's knots along both parameters; vertex (i, j) is number i * w.count + j."""

    u: Knots
    w: Knots

    @property
    def size(self) -> int:
        """Number of vertices."""
        return self.u.count * self.w.count

    @property
    def band(self) -> int:
        """How far apart two vertices' numbers may be that share a datum."""
        return (self.u.order - 1) * self.w.count + self.w.order - 1


@dataclass(frozen=True, eq=False)
class Rows:
    """The matrix C of equation 13 without its zeros: the products of the basis functions.

    Row i has products[i] at the vertices first[i] + offsets.
    """

    net: Net
    products: NDArray[np.float64]  # (n, orders' product)
    first: NDArray[np.intp]  # (n,), number of the first vertex
    offsets: NDArray[np.intp]  # (orders' product,)
    places: NDArray[np.intp]  # (n, orders' product), their sum

    def at(self, vertices: NDArray[np.float64]) -> NDArray[np.float64]:
        """C B, (n,) or (n, k) for vertices (size,) or (size, k)."""
        here = vertices.T.take(self.places, axis=-1)
        return np.asarray(np.einsum("ij,...ij->i...", self.products, here))

    def like(self, along_u: Basis, along_w: Basis) -> "Rows":
        """The rows for other bases of the same data, derivatives for instance."""
        return replace(self, products=_products(along_u, along_w))


def rows(net: Net, along_u: Basis, along_w: Basis) -> Rows:
    """The rows of C for data with these bases along u and w."""
    offsets = (np.arange(net.u.order)[:, None] * net.w.count + np.arange(net.w.order)).ravel()
    first = along_u.span * net.w.count + along_w.span
    return Rows(
        net=net,
        products=_products(along_u, along_w),
        first=first,
        offsets=offsets,
        places=first[:, None] + offsets,
    )


def _products(along_u: Basis, along_w: Basis) -> NDArray[np.float64]:
    products = along_u.values[:, None, :] * along_w.values[None, :, :]
    return np.ascontiguousarray(products.reshape(-1, products.shape[2]).T)


def normal_equations(
    data: Rows, heights: NDArray[np.float64], weights: NDArray[np.float64] | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """C^T W C as lower bands (band + 1, size), and C^T W D (size,) or (size, k).

    Data of one net cell touch the same vertices, so that a few of them at a time add one dense
    block of the orders' product squared: the work is n times that, and no matrix of data by
    vertices is made. heights is (n,) or (n, k).
    """
    net, wide = data.net, len(data.offsets)
    columns = heights.reshape(len(heights), -1)
    below, above = np.nonzero(np.subtract.outer(data.offsets, data.offsets) >= 0)
    lower = below * (wide + columns.shape[1]) + above  # of a block's products, its lower half
    offset = (data.offsets[below] - data.offsets[above]) * net.size + data.offsets[above]
    bands = np.zeros((net.band + 1) * net.size)
    side = np.zeros((columns.shape[1], net.size))
    for start in range(0, len(columns), CHUNK):
        here = slice(start, start + CHUNK)
        bunch, slot, first = _bunches(data.first[here])
        # each bunch's rows of C, and of C and D beside each other with their weights
        plain = np.zeros((len(first), BUNCH, wide))
        plain[bunch, slot] = data.products[here]
        heavy = np.zeros((len(first), BUNCH, wide + columns.shape[1]))
        heavy[bunch, slot, :wide] = data.products[here]
        heavy[bunch, slot, wide:] = columns[here]
        if weights is not None:
            heavy[bunch, slot] *= weights[here, None]
        blocks = plain.transpose(0, 2, 1) @ heavy
        halves = blocks.reshape(len(first), -1).take(lower, axis=1)
        bands += np.bincount((first[:, None] + offset).ravel(), halves.ravel(), len(bands))
        place = (first[:, None] + data.offsets).ravel()
        for k in range(len(side)):
            side[k] += np.bincount(place, blocks[..., wide + k].ravel(), net.size)
    return bands.reshape(net.band + 1, net.size), side.T.reshape(net.size, *heights.shape[1:])


def _bunches(
    cell: NDArray[np.intp],
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
    """Data (n,) of equal cells in bunches of up to 16: each datum's bunch and slot, their cells."""
    order = np.argsort(cell, kind="stable")
    sorted_cells = cell[order]
    starts = np.flatnonzero(np.diff(sorted_cells, prepend=-1))
    counts = np.diff(starts, append=len(cell))
    rank = np.arange(len(cell)) - np.repeat(starts, counts)
    bunches = -(-counts // BUNCH)
    before = np.cumsum(bunches) - bunches
    bunch, slot = np.empty_like(order), np.empty_like(order)
    bunch[order] = np.repeat(before, counts) + rank // BUNCH
    slot[order] = rank % BUNCH
    return bunch, slot, np.repeat(sorted_cells[starts], bunches)


def to_bands(net: Net, dense: NDArray[np.float64]) -> NDArray[np.float64]:
    """The lower bands (band + 1, size) of a symmetric matrix (size, size) that fits in them."""
    bands = np.zeros((net.band + 1, net.size))
    for below in range(net.band + 1):
        bands[below, : net.size - below] = np.diagonal(dense, -below)
    return bands


def bending(net: Net, u_size: float, w_size: float) -> NDArray[np.float64]:
    """Lower bands of the mean of Q_uu² + 2 Q_uw² + Q_ww² over the net's rectangle, exact.

    The rectangle is u_size by w_size: with metres the mean is in 1/m² for heights in metres.
    """
    along_u, mixed, along_w = _unit_bending(net)
    return along_u / u_size**4 + mixed / (u_size * w_size) ** 2 + along_w / w_size**4


@lru_cache(maxsize=8)
def _unit_bending(net: Net) -> tuple[NDArray[np.float64], ...]:
    """Lower bands of the integrals of Q_uu², 2 Q_uw² and Q_ww² over the unit square."""
    straight, across = ([overlaps(knots, k) for k in range(3)] for knots in (net.u, net.w))
    parts = [
        to_bands(net, np.asarray(factor * np.kron(straight[k], across[2 - k]), dtype=np.float64))
        for k, factor in ((2, 1.0), (1, 2.0), (0, 1.0))
    ]
    for part in parts:
        part.setflags(write=False)
    return tuple(parts)


@lru_cache(maxsize=8)
def vertex_bending(net: Net) -> NDArray[np.float64]:
    """Lower bands of the sum of squares of the second derivatives' vertices along u and w."""
    along_u, along_w = derivative_net(net.u, 2), derivative_net(net.w, 2)
    dense = np.kron(along_u.T @ along_u, np.eye(net.w.count))
    bands = to_bands(net, dense + np.kron(np.eye(net.u.count), along_w.T @ along_w))
    bands.setflags(write=False)
    return bands


@dataclass(frozen=True, eq=False)
class Factor:
    """The Cholesky factor of banded normal equations."""

    lower: NDArray[np.float64]  # (band + 1, size)

    def solve(self, side: NDArray[np.float64]) -> NDArray[np.float64]:
        """The vertices (size,) or (size, k) for right-hand sides of that shape."""
        from scipy.linalg import cho_solve_banded  # noqa: PLC0415 - see factorise

        return np.asarray(cho_solve_banded((self.lower, True), side, check_finite=False))


def factorise(bands: NDArray[np.float64]) -> Factor | None:
    """The factor, or None where the data and the penalty leave a vertex undecided."""
    from scipy.linalg import cholesky_banded  # noqa: PLC0415 - 0.05 s that outlines do without

    try:
        lower = cholesky_banded(bands, lower=True, check_finite=False)
    except np.linalg.LinAlgError:
        return None
    pivots = lower[0] ** 2
    return Factor(lower) if pivots.min() > MIN_PIVOT * bands[0].max() else None
