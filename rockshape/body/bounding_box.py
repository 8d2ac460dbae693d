"""Minimum-volume bounding box of points, continuous in the points."""

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from rockshape.body.lattice import spread_directions
from rockshape.numerics.arrays import Floats

SIDES = 200  # directions, half of them tried: the facet nearest to each bears a side of the box
TURNS = 30  # about each, over a right angle
FINER = (0.1, 0.01)  # of a turn: steps of the two searches about the best
SPREAD = 0.01  # of the volume: boxes that are larger by this much count 1/e of the smallest


def box_half_axes_m(points_m: Floats) -> Floats | None:
    """Half sides a >= b >= c, (3,), of the smallest box round points (n, 3); None where flat.

    One side is flush with a facet of the convex hull, and the box is turned about that side's
    normal to its least volume V: first by steps of three degrees, then by finer ones. Boxes of
    nearly one volume may be turned far apart, and their sides differ by a tenth; so that noise and
    a few points do not choose, the sides are geometric means over the boxes of all facets tried,
    weighted by exp(-(V/V₀ - 1)/0.01) with V₀ the least.

    Source: O'Rourke (1985), Finding minimal enclosing boxes, for sides flush with facets.
    """
    try:
        hull = ConvexHull(points_m)
    except (QhullError, ValueError):
        return None
    corners = points_m[hull.vertices]
    facets = hull.equations[:, :3]
    tried = spread_directions(SIDES)[: SIDES // 2]
    normals = facets[np.unique(np.argmax(np.abs(tried @ facets.T), axis=1))]
    flat = np.stack(_frames(normals), axis=1) @ corners.T  # (sides, 2, n)
    heights = np.ptp(normals @ corners.T, axis=1)
    step = np.pi / 2 / TURNS
    widths = _widths(flat, np.broadcast_to(step * np.arange(TURNS), (len(flat), TURNS)))
    best = step * np.argmin(widths.prod(axis=0), axis=1)
    each = np.arange(len(best))
    for finer in FINER:
        near = best[:, None] + finer * step * np.arange(-10, 11)
        widths = _widths(flat, near)
        chosen = np.argmin(widths.prod(axis=0), axis=1)
        best = near[each, chosen]
    boxes = np.sort(np.stack([*widths[:, each, chosen], heights], axis=1), axis=1)[:, ::-1]
    volumes = boxes.prod(axis=1)
    weights = np.exp(-(volumes / volumes.min() - 1) / SPREAD)
    return np.asarray(np.exp(weights @ np.log(boxes) / weights.sum()) / 2)


def _frames(normals: Floats) -> tuple[Floats, Floats]:
    """Two unit vectors (n, 3) at right angles to normals (n, 3) and to one another."""
    first = np.cross(normals, np.eye(3)[np.argmin(np.abs(normals), axis=1)])
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return first, np.cross(normals, first)


def _widths(flat: Floats, turns_rad: Floats) -> Floats:
    """Both widths (2, k, turns) of points on planes (k, 2, n) along axes turned by (k, turns)."""
    cosine, sine = np.cos(turns_rad), np.sin(turns_rad)
    axes = np.stack([np.stack([cosine, sine], axis=-1), np.stack([-sine, cosine], axis=-1)])
    return np.asarray(np.ptp(axes @ flat, axis=-1))
