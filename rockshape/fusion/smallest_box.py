"""Smallest box of points: the three sides of the upright box of least volume in any orientation."""

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.spatial import ConvexHull, QhullError
from scipy.spatial.transform import Rotation

MAX_DIRECTIONS = 150  # of the hull's facets, the largest first
REFINED = 3  # of the best starts


def smallest_box_m(points_m: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Sides (3,), longest first, of the smallest box that holds points (n, 3).

    A box lies on each large facet of the convex hull and turns about its normal until the rectangle
    across is smallest; the best few are refined by the simplex method over all turns, since of the
    smallest box two sides need only hold edges (O'Rourke 1985, Finding minimal enclosing boxes).
    None where the points do not span a volume.
    """
    try:
        hull = ConvexHull(points_m)
    except (QhullError, ValueError):
        return None
    corners = points_m[hull.vertices] - points_m[hull.vertices].mean(axis=0)
    boxes = sorted(
        (_box_along(corners, normal) for normal in _facets(hull)), key=lambda box: box[0]
    )
    starts = [frame for _, frame in boxes[:REFINED]]
    found = [_refined(corners, start) for start in starts]
    return min(found, key=lambda sides: float(np.prod(sides)))


def _facets(hull: ConvexHull) -> NDArray[np.float64]:
    """Normals (k, 3) of the hull's largest facets, triangles in one plane taken together."""
    a, b, c = (hull.points[hull.simplices[:, corner]] for corner in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    normals, facet = np.unique(np.round(hull.equations[:, :3], 6), axis=0, return_inverse=True)
    total = np.bincount(facet.reshape(-1), weights=area)
    order = np.argsort(-total)[:MAX_DIRECTIONS]
    chosen = normals[order]
    return np.asarray(chosen / np.linalg.norm(chosen, axis=1, keepdims=True))


def _box_along(
    corners: NDArray[np.float64], normal: NDArray[np.float64]
) -> tuple[float, NDArray[np.float64]]:
    """Volume of the smallest box with a side along a normal, and its frame, axes in rows."""
    across = np.linalg.svd(normal[None])[2][1:]
    # OpenCV's rectangle is of single precision, on corners about the origin
    _, _, angle_deg = cv2.minAreaRect((corners @ across.T).astype(np.float32))
    angle = np.deg2rad(angle_deg)
    first = np.cos(angle) * across[0] + np.sin(angle) * across[1]
    frame = np.array([first, np.cross(normal, first), normal])
    return float(np.prod(_sides(corners, frame))), frame


def _sides(corners: NDArray[np.float64], frame: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(np.ptp(corners @ frame.T, axis=0))


def _refined(corners: NDArray[np.float64], frame: NDArray[np.float64]) -> NDArray[np.float64]:
    """Sides (3,), longest first, of the smallest box near a frame."""

    def turned(vector: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(frame @ Rotation.from_rotvec(vector).as_matrix())

    start = np.vstack([np.zeros(3), 0.1 * np.eye(3)])
    found = minimize(
        lambda vector: float(np.prod(_sides(corners, turned(vector)))),
        np.zeros(3),
        method="Nelder-Mead",
        options={"initial_simplex": start, "maxfev": 150, "xatol": 1e-4, "fatol": 0.0},
    )
    sides = _sides(corners, turned(found.x))
    return np.sort(sides)[::-1]
