"""Picture of a mesh by parallel rays, and what is measured in it."""

import cv2
import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from scipy.optimize import linprog
from scipy.spatial import ConvexHull

from synth.geometry.mesh import Mesh
from synth.rocks.outlines.record import axis_ratio

EDGE_SPLIT = 16  # edge pixels are split into so many squared


def pictured(mesh: Mesh, across: np.ndarray, count: int) -> tuple[float, float, float, float]:
    """Return area, its hull's perimeter, axis ratio and its hull's inner radius of a picture.

    The plane has the axes `across` (2, 3). Parallel rays pass through the centres of count × count
    pixels; those at the edge are split. The perimeter is π times the mean width over all
    directions (Cauchy).
    """
    scene = EmbreeScene(robust=True)
    TriangleMesh(scene, mesh.vertices_m[mesh.faces].astype(np.float32))
    half_m = 1.05 * float(np.linalg.norm(mesh.vertices_m, axis=1).max())
    pixel_m = 2.0 * half_m / count
    grid = (np.arange(count) + 0.5) * pixel_m - half_m
    mask = np.stack([_hit(scene, across, np.column_stack([grid, np.full(count, y)])) for y in grid])
    core = np.ones((3, 3), np.uint8)
    inner = cv2.erode(mask.astype(np.uint8), core) > 0
    edge = (cv2.dilate(mask.astype(np.uint8), core) > 0) & ~inner
    places = np.argwhere(inner)
    whole_m = np.column_stack([grid[places[:, 1]], grid[places[:, 0]]])
    offsets = ((np.arange(EDGE_SPLIT) + 0.5) / EDGE_SPLIT - 0.5) * pixel_m
    shifts = np.stack(np.meshgrid(offsets, offsets), axis=-1).reshape(-1, 2)
    rows, columns = np.nonzero(edge)
    tried_m = np.column_stack([grid[columns], grid[rows]])[:, None] + shifts
    parts_m = np.concatenate(
        [part[_hit(scene, across, part)] for part in tried_m.transpose(1, 0, 2)]
    )
    points_m = np.concatenate([whole_m, parts_m])
    weights = np.repeat([1.0, 1.0 / EDGE_SPLIT**2], [len(whole_m), len(parts_m)])
    hull = ConvexHull(parts_m)
    turn_rad = np.pi * np.arange(3600) / 3600
    along_m = parts_m[hull.vertices] @ np.stack([np.cos(turn_rad), np.sin(turn_rad)])
    inside = linprog(
        [0.0, 0.0, -1.0],
        A_ub=np.column_stack([hull.equations[:, :2], np.ones(len(hull.equations))]),
        b_ub=-hull.equations[:, 2],
        bounds=[(None, None)] * 2 + [(0, None)],
    )
    return (
        float(weights.sum()) * pixel_m**2,
        float(np.pi * np.ptp(along_m, axis=0).mean()),
        axis_ratio(np.cov(points_m.T, aweights=weights)),
        float(inside.x[2]),
    )


def _hit(scene: EmbreeScene, across: np.ndarray, points_m: np.ndarray) -> np.ndarray:
    """Tell through which points of the plane, (n, 2), the ray meets the body."""
    ray = np.cross(across[0], across[1])
    origins = (points_m @ across - 2.0 * ray).astype(np.float32)
    rays = np.broadcast_to(ray, origins.shape).astype(np.float32)
    return np.asarray(scene.run(origins, rays) >= 0)
