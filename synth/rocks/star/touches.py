"""Places where a star-shaped surface touches its smallest box and the calipers.

They are found on the surface itself, so that they do not depend on the mesh that is made of it.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull

from synth.arrays import Floats
from synth.geometry.caliper import caliper_axes
from synth.geometry.min_volume_box import smallest_box
from synth.geometry.vectors import perpendicular
from synth.rocks.sphere import unit_sphere
from synth.rocks.star.surface import EvenPoints, StarSurface

SUBDIVISIONS = 6  # of the sphere whose directions the search starts from
_EDGE_RAD = 0.02  # from one of them to the next
_GRID = np.linspace(-1.0, 1.0, 9)
_ZOOM, _ZOOMS = 3.0, 7  # 1e-5 rad at the end
_TURNS = 3  # of a chord towards its own ends


@dataclass(frozen=True, eq=False)
class Touches:
    """Axes of a surface's smallest box, and the directions of the points that span it.

    Of the box along these axes, and of the caliper half-axes, each side's two points.
    """

    axes: Floats  # (3, 3), rows are the directions of the sides
    directions: Floats  # (12, 3), from the middle of the surface


def find_touches(surface: StarSurface, even: EvenPoints) -> Touches:
    """Touches of a surface's smallest box and of its longest extents at right angles.

    The box's axes are those of the smallest box of the surface's points along the directions of an
    even mesh, which are known; the points that touch it are then sought between those directions.
    """
    search = _Search(surface, unit_sphere(even.subdivisions)[0], even.points)
    hull = ConvexHull(even.points)
    axes = smallest_box(even.points, hull=hull).axes
    return Touches(axes, np.concatenate([search.ends(axes), search.calipers(hull)]))


@dataclass(frozen=True, eq=False)
class _Search:
    """Search for the farthest points of a surface along any way, from known points."""

    surface: StarSurface
    directions: Floats  # (n, 3)
    points: Floats  # (n, 3)

    def ends(self, ways: Floats) -> Floats:
        """Directions (2k, 3) of the points farthest along unit vectors (k, 3), and against them."""
        both = np.concatenate([ways, -ways])
        found = self.directions[np.argmax(self.points @ both.T, axis=0)]
        reach = _EDGE_RAD
        for _ in range(_ZOOMS):
            tried = _round(found, reach)  # (2k, patch, 3)
            points, _ = self.surface.points(tried.reshape(-1, 3))
            along = np.einsum("kpi,ki->kp", points.reshape(tried.shape), both)
            found = tried[np.arange(len(both)), along.argmax(axis=1)]
            reach /= _ZOOM
        return np.asarray(found)

    def calipers(self, hull: ConvexHull) -> Floats:
        """Directions (6, 3) of the ends of L, I and S."""
        first, second, _ = caliper_axes(self.points, hull=hull)
        first = self._turned(first, np.zeros((3, 3)))
        second = self._turned(second, np.outer(first, first))
        return self.ends(np.stack([first, second, np.cross(first, second)]))

    def _turned(self, way: Floats, across: Floats) -> Floats:
        """Unit vector along the longest chord near one, across those of a projection (3, 3)."""
        for _ in range(_TURNS):
            one, two = self.surface.points(self.ends(way[None]))[0]
            way = (one - two) - across @ (one - two)
            way /= np.linalg.norm(way)
        return way


def _round(middles: Floats, reach: float) -> Floats:
    """Directions (k, patch, 3) on a square grid round unit vectors (k, 3)."""
    first, second = perpendicular(middles)
    one, two = (part.reshape(1, -1, 1) for part in np.meshgrid(reach * _GRID, reach * _GRID))
    tried = middles[:, None] + one * first[:, None] + two * second[:, None]
    return np.asarray(tried / np.linalg.norm(tried, axis=2, keepdims=True))
