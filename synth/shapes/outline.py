"""Rounded convex polygons Q ⊕ disc: exact area, perimeter, roundness, moments and rectangle."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

Floats = NDArray[np.float64]

_ARC_STEP_RAD = 0.02


@dataclass(frozen=True, eq=False)
class RoundedPolygon:
    """The points within a radius of a convex polygon."""

    corners_px: Floats  # (n, 2), anticlockwise, x right and y up
    radius_px: float

    def __post_init__(self) -> None:
        """Make the array read-only."""
        self.corners_px.setflags(write=False)

    def area_px2(self) -> float:
        """Return A₀ + L₀r + πr² (Steiner)."""
        r = self.radius_px
        return polygon_area(self.corners_px) + _length(self.corners_px) * r + np.pi * r**2

    def perimeter_px(self) -> float:
        """Return L₀ + 2πr (Steiner)."""
        return _length(self.corners_px) + 2.0 * np.pi * self.radius_px

    def roundness(self) -> float:
        """Return r/(r_in + r): the corners' radius over the largest inscribed disc's (Wadell)."""
        return self.radius_px / (largest_disc_px(self.corners_px) + self.radius_px)

    def outline_px(self) -> Floats:
        """Return points on the outline, (n, 2), anticlockwise, its arcs in fine steps."""
        edges = np.roll(self.corners_px, -1, axis=0) - self.corners_px
        bearing_rad = np.unwrap(np.arctan2(edges[:, 1], edges[:, 0])) - np.pi / 2.0
        points = []
        for index, corner in enumerate(self.corners_px):
            start, end = bearing_rad[index - 1], bearing_rad[index]
            turn = (end - start) % (2.0 * np.pi)
            pieces = max(2, int(np.ceil(turn / _ARC_STEP_RAD)))
            along = start + turn * np.linspace(0.0, 1.0, pieces + 1)
            arc = np.column_stack([np.cos(along), np.sin(along)])
            points.append(corner + self.radius_px * arc)
        return np.concatenate(points)


def polygon_area(corners: Floats) -> float:
    """Return the signed area of a polygon (n, 2), positive anticlockwise (Gauss)."""
    following = np.roll(corners, -1, axis=0)
    crosses = corners[:, 0] * following[:, 1] - corners[:, 1] * following[:, 0]
    return float(crosses.sum() / 2.0)


def axis_ratio(corners: Floats) -> float:
    """Return the minor over the major axis of the ellipse with a polygon's second moments."""
    following = np.roll(corners, -1, axis=0)
    crosses = corners[:, 0] * following[:, 1] - corners[:, 1] * following[:, 0]
    total = corners + following
    area = crosses.sum() / 2.0
    centre = crosses @ total / (6.0 * area)
    squares = np.einsum("n,ni,nj->ij", crosses, corners, corners)
    squares += np.einsum("n,ni,nj->ij", crosses, following, following)
    squares += np.einsum("n,ni,nj->ij", crosses, total, total)
    low, high = np.linalg.eigvalsh(squares / (24.0 * area) - np.outer(centre, centre))
    return float(np.sqrt(low / high))


def rectangle(corners: Floats) -> tuple[float, float, float]:
    """Return the smallest rectangle round a convex polygon: long side, short side, bearing (rad).

    One of its sides is flush with an edge of the polygon (Freeman and Shapira 1975). The bearing
    is the long side's.
    """
    edges = np.roll(corners, -1, axis=0) - corners
    bearings = np.arctan2(edges[:, 1], edges[:, 0])
    best = (np.inf, 0.0, 0.0, 0.0)
    for bearing in bearings:
        along = corners @ np.array([np.cos(bearing), np.sin(bearing)])
        across = corners @ np.array([-np.sin(bearing), np.cos(bearing)])
        length, width = float(np.ptp(along)), float(np.ptp(across))
        turned = bearing if length >= width else bearing + np.pi / 2.0
        best = min(best, (length * width, max(length, width), min(length, width), float(turned)))
    return best[1:]


def largest_disc_px(corners_px: Floats) -> float:
    """Return the radius of a largest disc inside a convex polygon."""
    edges = np.roll(corners_px, -1, axis=0) - corners_px
    normals = np.column_stack([edges[:, 1], -edges[:, 0]])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    found = linprog(
        [0.0, 0.0, -1.0],
        A_ub=np.column_stack([normals, np.ones(len(normals))]),
        b_ub=np.einsum("ij,ij->i", normals, corners_px),
        bounds=[(None, None), (None, None), (0, None)],
    )
    return float(found.x[2])


def _length(corners: Floats) -> float:
    return float(np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1).sum())
