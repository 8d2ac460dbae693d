"""Triangulation of points in the image: the choice of vertices, and facets between them."""

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, Delaunay

from synth.arrays import Floats, Ints, Mask

_FLAT = 1e-9  # of the values' spread: smaller errors are none
_GROWTH = 0.5  # vertices added in a round, as a share of those that are there
_INSIDE = 0.5  # least share of a facet's places that must be inside


def adaptive_vertices(points: Floats, values: Floats, triangles: int) -> Ints:
    """Indices of vertices (k,) by greedy insertion: a mesh finer where values bend.

    From the hull's corners on, the worst point of each of the worst triangles becomes a vertex,
    round by round, until there are enough triangles or all points lie on them. Points (n, 2),
    values (n,); empty where the points span no area.

    Source: Garland and Heckbert (1995), Fast polygonal approximation of terrains and height fields.
    """
    if not _spans(points):
        return np.empty(0, dtype=np.int64)
    corners = np.sort(ConvexHull(points).vertices).astype(np.int64)
    tolerance = _FLAT * float(np.ptp(values) + np.abs(values).max())
    while True:
        mesh = Delaunay(points[corners])
        missing = triangles - len(mesh.simplices)
        if missing <= 0:
            return corners
        found, simplex = _interpolated(mesh, values[corners], points)
        error = np.where(simplex >= 0, np.abs(found - values), 0.0)
        order = np.argsort(-error, kind="stable")
        _, first = np.unique(simplex[order], return_index=True)
        worst = order[np.sort(first)]  # one of each triangle, the worst first
        worst = worst[error[worst] > tolerance]
        if not len(worst):
            return corners
        count = min(-(-missing // 2), 1 + int(_GROWTH * len(corners)))
        corners = np.concatenate([corners, worst[:count]])


def regular_vertices(points: Floats, _values: Floats, triangles: int) -> Ints:
    """Indices of vertices (k,) nearest to the middles of even cells, with the hull's corners."""
    if not _spans(points):
        return np.empty(0, dtype=np.int64)
    low, high = points.min(axis=0), points.max(axis=0)
    cell = np.sqrt(np.prod(high - low) / (triangles / 2.0))
    place = (points - low) / cell
    cells = np.floor(place).astype(np.int64)
    key = cells[:, 0] + cells[:, 1] * (cells[:, 0].max() + 1)
    off = ((place - cells - 0.5) ** 2).sum(axis=1)
    order = np.lexsort([off, key])
    _, first = np.unique(key[order], return_index=True)
    return np.union1d(order[first], ConvexHull(points).vertices).astype(np.int64)


def mesh_values(corners: Floats, values: Floats, places: Floats, inside: Mask) -> Floats:
    """Values at places (..., 2), linear on the facets between corners (k, 2); NaN outside.

    A facet of whose places less than half are inside is left out.
    """
    if not len(corners):
        return np.full(places.shape[:-1], np.nan)
    mesh = Delaunay(corners)
    found, simplex = _interpolated(mesh, values, places.reshape(-1, 2))
    count = np.bincount(simplex + 1, minlength=len(mesh.simplices) + 1)
    known = np.bincount(simplex + 1, weights=inside.ravel(), minlength=len(count))
    kept = known >= _INSIDE * count
    kept[0] = False  # outside
    return np.where(kept[simplex + 1], found, np.nan).reshape(places.shape[:-1])


def _interpolated(
    mesh: Delaunay, values: Floats, places: Floats
) -> tuple[Floats, NDArray[np.intp]]:
    """Linear values at places (n, 2), and their triangles' numbers, −1 outside."""
    simplex = mesh.find_simplex(places)
    frame = mesh.transform[simplex]
    two = np.einsum("nij,nj->ni", frame[:, :2], places - frame[:, 2])
    weights = np.column_stack([two, 1.0 - two.sum(axis=1)])
    return (weights * values[mesh.simplices[simplex]]).sum(axis=1), simplex


def _spans(points: Floats) -> bool:
    """Whether points (n, 2) span an area."""
    if len(points) < 3:
        return False
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return bool(spread[1] > 1e-9 * spread[0])
