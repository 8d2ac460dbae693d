"""The largest circle inside an outline."""

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.outline.resample import even_outline
from rockshape.outline.trace import signed_area

_CONTACTS = 256  # points that can touch it: between them a circle passes by 1e-4 of its radius
_UNIT = 4096  # the triangulation tells points apart by a fixed distance, 1e-7
_NO_AREA = 1e-6  # of the extent squared


def inscribed_radius(outline: NDArray[np.float64]) -> float:
    """Radius of the largest circle inside a closed outline (n, 2); 0 where there is no inside."""
    return inscribed_circle(outline)[1]


def inscribed_circle(outline: NDArray[np.float64]) -> tuple[tuple[float, float], float]:
    """Centre and radius of the largest circle inside a closed outline (n, 2), in its unit.

    Of 256 points evenly along it, every triangle of their Delaunay triangulation has a
    circumscribed circle with no point inside; the largest whose centre lies inside the outline
    is the one. In single precision: true to 1e-7. Of radius 0 for an outline without inside.
    """
    points = even_outline(outline, _CONTACTS)
    if len(points) == 0:
        return (0.0, 0.0), 0.0
    scale = float(np.ptp(points, axis=0).max())
    middle = points.mean(axis=0)
    points = (points - middle) / scale
    if abs(signed_area(points)) < _NO_AREA:
        return (0.0, 0.0), 0.0
    first, second, third = np.moveaxis(_triangles(points), 1, 0)
    one, two = second - first, third - first
    cross = 2 * (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
    level = np.column_stack([(one**2).sum(axis=1), (two**2).sum(axis=1)])
    with np.errstate(divide="ignore", invalid="ignore"):
        x = (two[:, 1] * level[:, 0] - one[:, 1] * level[:, 1]) / cross
        y = (one[:, 0] * level[:, 1] - two[:, 0] * level[:, 0]) / cross
    radius = np.hypot(x, y)
    polygon = points.astype(np.float32)
    # none inside is larger than the half extent; flat triangles have none
    for index in np.argsort(-np.where(radius <= 1, radius, 0.0)):
        centre = (float(first[index, 0] + x[index]), float(first[index, 1] + y[index]))
        if radius[index] <= 1 and cv2.pointPolygonTest(polygon, centre, measureDist=False) > 0:
            x_own, y_own = (middle + scale * np.array(centre)).tolist()
            return (x_own, y_own), scale * float(radius[index])
    return (0.0, 0.0), 0.0


def _triangles(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners (k, 3, 2) of the Delaunay triangles of points (n, 2) within 1 of the origin."""
    side = 2 * _UNIT
    plane = cv2.Subdiv2D((-side, -side, 2 * side, 2 * side))
    plane.insert((_UNIT * points).astype(np.float32).tolist())
    corners = np.asarray(plane.getTriangleList()).reshape(-1, 3, 2) / float(_UNIT)
    # the triangulation starts from three points far outside
    return np.asarray(corners[(np.abs(corners) <= 1).all(axis=(1, 2))])
