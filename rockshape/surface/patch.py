"""The points of a rock laid over the plane that faces the camera."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class SurfacePatch:
    """Points of a rock as a graph over the image: metres across and metres towards the camera."""

    u_m: NDArray[np.float64]  # (n,), along the image's columns
    w_m: NDArray[np.float64]  # (n,), along the image's rows
    height_m: NDArray[np.float64]  # (n,), towards the camera


def view_axes(points_m: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Unit vectors (3, 3) in rows: along u, along w, and from the points' centroid to the camera.

    None for no points, and for points that lie round the camera itself or right beside it, which no
    image shows.
    """
    if len(points_m) == 0:
        return None
    centroid = points_m.mean(axis=0)
    distance = np.linalg.norm(centroid)
    if not abs(centroid[0]) < distance:
        return None
    away = centroid / distance
    across = np.array([1.0, 0.0, 0.0]) - away[0] * away
    across /= np.linalg.norm(across)
    return np.stack([across, np.cross(away, across), -away])


def view_patch(points_m: NDArray[np.float64]) -> SurfacePatch | None:
    """Lay the points, (n, 3) in the camera frame, over the plane that faces the camera.

    The height is measured along the ray to the points' centroid, so that the visible surface is a
    graph; u follows the image's x axis and w its y axis, both in metres. None where `view_axes` is.
    """
    axes = view_axes(points_m)
    if axes is None:
        return None
    u, w, height = ((points_m - points_m.mean(axis=0)) @ axes.T).T
    return SurfacePatch(u_m=u, w_m=w, height_m=height)
