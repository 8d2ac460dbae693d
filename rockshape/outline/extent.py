"""The extent of an outline: convex hull, Feret diameters, smallest rectangle."""

import cv2
import numpy as np
from numpy.typing import NDArray

MIN_WIDTH_PX = 4.0  # least Feret diameter below which pixels are what an outline's shape is made of


def convex_hull(outline: NDArray[np.float64]) -> NDArray[np.float64]:
    """Those of points (n, 2) that are corners of their convex hull, (k, 2), in order round it.

    All points where there are fewer than three. Found in single precision, so a point within 1e-7
    of their extent of the hull may count as on it.
    """
    if len(outline) < 3:
        return outline
    local = (outline - outline[0]).astype(np.float32)
    return np.asarray(outline[cv2.convexHull(local, returnPoints=False)[:, 0]])


def feret_diameters(outline: NDArray[np.float64]) -> tuple[float, float]:
    """Least and greatest distance of two parallel lines that hold an outline (n, 2) between them.

    The greatest is the distance of two corners of the convex hull, the least is across one of its
    edges. (0, 0) for a single place; NaN for no point.
    Source: Feret (1930); edges by Freeman and Shapira (1975).
    """
    if len(outline) == 0:
        return float("nan"), float("nan")
    hull = convex_hull(outline)
    x, y = hull.T
    greatest = float(np.sqrt(((x[:, None] - x) ** 2 + (y[:, None] - y) ** 2).max()))
    sides = _flush_sides(hull)
    return (float(sides[1].min()) if sides.size else 0.0), greatest


def smallest_rectangle(outline: NDArray[np.float64]) -> tuple[float, float]:
    """Long and short side of the rectangle of least area that holds an outline (n, 2).

    One of its sides is flush with an edge of the convex hull. (0, 0) for a single place; NaN for
    no point.
    Source: Freeman and Shapira (1975).
    """
    if len(outline) == 0:
        return float("nan"), float("nan")
    sides = _flush_sides(convex_hull(outline))
    if not sides.size:
        return 0.0, 0.0
    along, across = sides[:, np.argmin(sides[0] * sides[1])]
    return float(max(along, across)), float(min(along, across))


def _flush_sides(hull: NDArray[np.float64]) -> NDArray[np.float64]:
    """Extents (2, k) of a hull along and across each of its edges that has a length."""
    edges = np.roll(hull, -1, axis=0) - hull
    lengths = np.hypot(edges[:, 0], edges[:, 1])
    units = edges[lengths > 0] / lengths[lengths > 0, None]
    across = np.column_stack([-units[:, 1], units[:, 0]])
    return np.asarray([np.ptp(hull @ way.T, axis=0) for way in (units, across)])
