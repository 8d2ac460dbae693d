"""Rounded convex polygons Q ⊕ disc: exact area, perimeter, roundness, moments and rectangle."""

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from synth.arrays import Floats

_ARC_STEP_RAD = 0.02
_SINGULAR = 1e-9  # three edges that determine no disc
_SLACK = 1e-10


@dataclass(frozen=True, eq=False)
class RoundedPolygon:
    """Rounded polygon: the points within a radius of a convex polygon."""

    corners_px: Floats  # (n, 2), anticlockwise, x right and y up
    radius_px: float

    def __post_init__(self) -> None:
        """Make the array read-only."""
        self.corners_px.setflags(write=False)

    def area_px2(self) -> float:
        """Area A₀ + L₀r + πr² (Steiner)."""
        r = self.radius_px
        return polygon_area(self.corners_px) + _length(self.corners_px) * r + np.pi * r**2

    def perimeter_px(self) -> float:
        """Perimeter L₀ + 2πr (Steiner)."""
        return _length(self.corners_px) + 2.0 * np.pi * self.radius_px

    def roundness(self) -> float:
        """Roundness r/(r_in + r), the corners' radius over the inscribed disc's (Wadell)."""
        return self.radius_px / (largest_disc_px(self.corners_px) + self.radius_px)

    def joints_px(self) -> Floats:
        """Start and end of each corner's arc, (n, 2, 2), anticlockwise."""
        following = np.roll(self.corners_px, -1, axis=0) - self.corners_px
        normals = np.column_stack([following[:, 1], -following[:, 0]])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        arms = self.radius_px * np.stack([np.roll(normals, 1, axis=0), normals], axis=1)
        return np.asarray(self.corners_px[:, None] + arms)

    def outline_px(self) -> Floats:
        """Points on the outline, (n, 2), anticlockwise, its arcs in fine steps."""
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
    """Signed area of a polygon (n, 2), positive anticlockwise (Gauss)."""
    following = np.roll(corners, -1, axis=0)
    crosses = corners[:, 0] * following[:, 1] - corners[:, 1] * following[:, 0]
    return float(crosses.sum() / 2.0)


def axis_ratio(corners: Floats) -> float:
    """Axis ratio: minor over major axis of the ellipse with a polygon's second moments."""
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


def rectangle(corners: Floats, *, margin: float = 0.0) -> tuple[float, float, float]:
    """Smallest rectangle round a convex polygon: long side, short side, bearing (rad).

    One of its sides is flush with an edge of the polygon (Freeman and Shapira 1975). The bearing
    is the long side's. With a margin each corner is thickened to a disc of that radius, which
    adds twice the margin to every side, and so can make another rectangle the smallest.
    """
    edges = np.roll(corners, -1, axis=0) - corners
    bearings = np.arctan2(edges[:, 1], edges[:, 0])
    best = (np.inf, 0.0, 0.0, 0.0)
    for bearing in bearings:
        along = corners @ np.array([np.cos(bearing), np.sin(bearing)])
        across = corners @ np.array([-np.sin(bearing), np.cos(bearing)])
        length = float(np.ptp(along)) + 2.0 * margin
        width = float(np.ptp(across)) + 2.0 * margin
        turned = bearing if length >= width else bearing + np.pi / 2.0
        best = min(best, (length * width, max(length, width), min(length, width), float(turned)))
    return best[1:]


def largest_disc_px(corners_px: Floats) -> float:
    """Radius of a largest disc inside a convex polygon.

    A largest disc touches three edges at least (two parallel ones allow it to be pushed to a
    third): of the discs that touch three given edges, the largest that keeps inside all.
    """
    edges = np.roll(corners_px, -1, axis=0) - corners_px
    normals = np.column_stack([edges[:, 1], -edges[:, 0]])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    sides = np.column_stack([normals, np.ones(len(normals))])  # n·centre + radius <= offset
    offsets = np.einsum("ij,ij->i", normals, corners_px)
    triples = np.array(list(combinations(range(len(edges)), 3)))
    triples = triples[np.abs(np.linalg.det(sides[triples])) > _SINGULAR]
    discs = np.linalg.solve(sides[triples], offsets[triples][..., None])[..., 0]
    slack = _SLACK * np.abs(offsets - offsets.mean()).max() + _SLACK
    inside = (discs @ sides.T <= offsets + slack).all(axis=1)
    return float(discs[inside, 2].max())


def _length(corners: Floats) -> float:
    return float(np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1).sum())
