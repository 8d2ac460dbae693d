"""Surface patches of a view: thinned points of rocks and the ground about them, with normals."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from rockshape.fusion.posed_view import PosedView
from rockshape.fusion.voxels import thinned

CELLS = 16.0  # across a large rock
LARGE = 90.0  # percentile of the rocks' sizes
NEIGHBOURS = 10  # of a point, itself among them, that its normal is of
FLAT = 0.15  # share of the variance off their plane, above which neighbours are an edge
MARGIN = 2.0  # of the ground about the rocks, in large rocks


@dataclass(frozen=True, eq=False)
class Patches:
    """Points (n, 3) in the world, their normals (n, 3) towards the camera."""

    points_m: NDArray[np.float64]
    normals: NDArray[np.float64]


def rock_size_m(views: tuple[PosedView, ...]) -> float:
    """Extent of the large rocks, the longest side of each upright box; NaN without rocks."""
    sizes = [np.ptp(rock.points_m, axis=0).max() for view in views for rock in view.rocks]
    return float(np.percentile(sizes, LARGE)) if sizes else float("nan")


def patches(view: PosedView, *, size_m: float) -> Patches:
    """Patches of a view whose large rocks have a size."""
    rocks = [rock.points_m for rock in view.rocks]
    if not rocks:
        return Patches(np.empty((0, 3)), np.empty((0, 3)))
    side_m = size_m / CELLS
    rock_m = thinned(np.vstack(rocks), side_m)
    ground_m = thinned(view.ground_m, 2 * side_m)
    if len(ground_m):
        near = cKDTree(rock_m).query(ground_m, distance_upper_bound=MARGIN * size_m)[0]
        ground_m = ground_m[np.isfinite(near)]
    parts = [_oriented(part) for part in (rock_m, ground_m) if len(part) >= NEIGHBOURS]
    if not parts:
        return Patches(np.empty((0, 3)), np.empty((0, 3)))
    points, normals = (np.vstack(each) for each in zip(*parts, strict=True))
    return Patches(view.pose.to_world(points), normals @ view.pose.camera_to_world.T)


def _oriented(points_m: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Points (k, 3) of a camera's frame that lie on smooth surface, and their normals."""
    _, near = cKDTree(points_m).query(points_m, NEIGHBOURS)
    about = points_m[near] - points_m[near].mean(axis=1, keepdims=True)
    spread, axes = np.linalg.eigh(np.einsum("nki,nkj->nij", about, about))
    normals = axes[:, :, 0]
    normals = np.where((normals * points_m).sum(axis=1, keepdims=True) > 0, -normals, normals)
    smooth = spread[:, 0] < FLAT * spread[:, 1]
    return points_m[smooth], normals[smooth]
