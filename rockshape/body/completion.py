"""Completion of a rock's visible surface by what its far side and its foot may be."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rockshape.body.lattice import spread_directions
from rockshape.ellipsoid import Ellipsoid
from rockshape.ground.plane import Plane
from rockshape.numerics.robust_scale import median_scale

DIRECTIONS = 400  # whose outermost points stand for all
DEPARTURE = 0.025  # from its ellipsoid over its size, at which a rock's foot lies half way

SeenPast = Callable[[NDArray[np.float64]], NDArray[np.bool_]]


def completed(
    points_m: NDArray[np.float64],
    ellipsoid: Ellipsoid,
    *,
    plane: Plane | None,
    seen_past: SeenPast,
) -> NDArray[np.float64]:
    """Outermost points (m, 3) of a body of which points_m (n, 3) are the visible side.

    The far side is the visible one reflected in the ellipsoid's centre, what would be below the
    ground raised onto it. The foot of a visible point lies below it, between the ellipsoid's
    underside and the ground: at q⁴/(q⁴ + 0.025⁴) of the way, where q is the points' robust standard
    deviation from the ellipsoid over the rock's size. An ellipsoid has its own underside; a rock,
    which lies on a flat side, is about as wide at its foot as above. Of both, what `seen_past`
    tells the camera to have seen past is left out.
    """
    outer = _outermost(points_m)
    far = 2 * ellipsoid.centre_m - outer
    if plane is None:
        added = far
    else:
        size_m = 2 * float(ellipsoid.half_axes_m[1])
        departure = median_scale(ellipsoid.radial_distance_m(points_m)) / size_m
        share = departure**4 / (departure**4 + DEPARTURE**4)
        below = np.minimum(plane.height_m(far), 0)
        high = plane.height_m(outer)
        under = np.clip(_thickness_m(ellipsoid, outer, plane.normal), 0, high)
        drop = under + share * (high - under)
        added = np.concatenate(
            [far - below[:, None] * plane.normal, outer - drop[:, None] * plane.normal]
        )
    return np.concatenate([outer, added[~seen_past(added)]])


def _thickness_m(
    ellipsoid: Ellipsoid, points_m: NDArray[np.float64], up: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Way (n,) down from points (n, 3) near an ellipsoid's top to its underside.

    Where the line passes it by, that to the line's point nearest to it.
    """
    start = ellipsoid.to_sphere(points_m)
    way = ellipsoid.axes @ up / ellipsoid.half_axes_m
    square, along = way @ way, start @ way
    reach = np.maximum(along**2 - square * ((start**2).sum(axis=1) - 1), 0)
    return np.asarray((along + np.sqrt(reach)) / square)


def _outermost(points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points (m, 3), of (n, 3), that are farthest along one of 400 directions."""
    chosen = np.unique(np.argmax(spread_directions(DIRECTIONS) @ points_m.T, axis=1))
    return np.asarray(points_m[chosen])
