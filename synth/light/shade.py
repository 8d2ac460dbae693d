"""Shadow candidates: the bodies' outlines as the sun sees them."""

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats, Singles
from synth.light.body import Body

_CELLS = 2048  # along the longer side
_MIN_CELL_M = 0.01


class ShadowMap:
    """Mask of rocks and pebbles seen from the sun, a little too large.

    It spares the shadow rays of points that nothing can stand before. Without either, as on
    rippled ground, which shades itself, shadow is possible everywhere.
    """

    def __init__(self, rocks: Sequence[Body], stones: Sequence[Body], towards_sun: Floats) -> None:
        self._map: NDArray[np.uint8] | None = None
        casters = [*rocks, *stones]
        if not casters:
            return
        helper = np.eye(3)[np.argmin(np.abs(towards_sun))]
        across = np.cross(towards_sun, helper)
        across /= np.linalg.norm(across)
        axes = np.stack([across, np.cross(towards_sun, across)], axis=1)
        shadows_m = [body.vertices_m @ axes for body in casters]
        low_m = np.min([shadow.min(axis=0) for shadow in shadows_m], axis=0)
        high_m = np.max([shadow.max(axis=0) for shadow in shadows_m], axis=0)
        self._cell_m = max(_MIN_CELL_M, float((high_m - low_m).max()) / _CELLS)
        self._axes = axes.astype(np.float32) / np.float32(self._cell_m)
        self._corner = (low_m / self._cell_m - 3.0).astype(np.float32)
        size = np.ceil((high_m - low_m) / self._cell_m).astype(int) + 7
        picture = np.zeros((size[1], size[0]), dtype=np.uint8)
        for body, shadow_m in zip(casters[len(rocks) :], shadows_m[len(rocks) :], strict=True):
            cells = np.rint(shadow_m / self._cell_m - self._corner).astype(np.int32)
            picture[cells[:, 1], cells[:, 0]] = 1
            reach = 2 * int(np.ceil(_longest_edge_m(body) / self._cell_m)) + 1
            picture = _grown(picture, reach)
        for shadow_m in shadows_m[: len(rocks)]:
            places = np.rint(shadow_m / self._cell_m - self._corner).astype(np.int32)
            cv2.fillConvexPoly(picture, cv2.convexHull(places), 1)
        self._map = _grown(picture, 3)

    def possible(self, points_m: Singles) -> NDArray[np.bool_]:
        """Mask of points (n, 3) that may lie in shadow."""
        if self._map is None:
            return np.ones(len(points_m), dtype=bool)
        cells = np.rint(points_m @ self._axes - self._corner).astype(np.int32)
        rows, cols = self._map.shape
        inside = (cells[:, 0] >= 0) & (cells[:, 0] < cols)
        inside &= (cells[:, 1] >= 0) & (cells[:, 1] < rows)
        found = np.zeros(len(points_m), dtype=bool)
        chosen = np.flatnonzero(inside)
        found[chosen] = self._map[cells[chosen, 1], cells[chosen, 0]] > 0
        return found


def _longest_edge_m(body: Body) -> float:
    corners_m = body.vertices_m[body.faces]
    edges_m = np.linalg.norm(corners_m - np.roll(corners_m, 1, axis=1), axis=2)
    return float(edges_m.max())


def _grown(picture: NDArray[np.uint8], side: int) -> NDArray[np.uint8]:
    grown = cv2.dilate(picture, np.ones((side, side), dtype=np.uint8))
    return np.asarray(grown, dtype=np.uint8)
