"""Settling of rocks: the side that a rock rests on, and the share of it that is buried."""

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from synth.arrays import Floats
from synth.geometry.mesh import Mesh

_ONE_PLANE = 1e-6  # hull facets whose normals differ less are one side


def lowest_side(vertices_m: Floats, *, rng: np.random.Generator | None = None) -> Floats:
    """Plane (4,) of the side of a body on which it lies stably, n·x + d = 0, n outward.

    The side of the convex hull nearest to the centroid, the origin, goes down: the lowest place
    the centroid can take, so the body cannot roll. With `rng` the rock falls from a random
    attitude instead, and rolls to the lowest side it can reach downhill.
    """
    hull = ConvexHull(vertices_m)
    side = int(np.argmin(-hull.equations[:, 3])) if rng is None else _rolled(hull, rng)
    return np.asarray(hull.equations[side])


def lying_turn(plane: Floats, *, yaw_rad: float) -> Floats:
    """Rotation (3, 3) that lays the side of a plane (4,) down and turns it about the vertical."""
    tilt = shortest_turn(plane[:3], np.array([0.0, 0.0, -1.0]))
    cosine, sine = np.cos(yaw_rad), np.sin(yaw_rad)
    yaw = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    return np.asarray(yaw @ tilt)


def _rolled(hull: ConvexHull, rng: np.random.Generator) -> int:
    """Side on which a body comes to rest that falls from a random attitude.

    It meets the ground with the side below its centroid, the origin, and topples over an edge as
    long as the next side lets the centroid sink: down the distances d of the hull's planes.
    """
    normals, distances_m = hull.equations[:, :3], -hull.equations[:, 3]
    downward = rng.standard_normal(3)
    slant = normals @ (downward / np.linalg.norm(downward))
    side = int(np.argmin(np.where(slant > 1e-9, distances_m / np.maximum(slant, 1e-9), np.inf)))
    while True:
        flush = np.flatnonzero(normals @ normals[side] > 1.0 - _ONE_PLANE)
        neighbours = np.unique(hull.neighbors[flush])
        lowest = int(neighbours[np.argmin(distances_m[neighbours])])
        if distances_m[lowest] >= distances_m[side] * (1.0 - 1e-9):
            return side
        side = lowest


def buried_fraction(mesh: Mesh, clearances_m: Floats) -> float:
    """Share of a body's volume below the ground, given its vertices' heights over it.

    Heights over the ground instead of z are a shear, which keeps volumes. By Gauss the volume
    above is ∮ max(z, 0) n_z dA, and over a triangle in which z is linear that is its signed area
    in plan times the mean of max(z, 0), a closed form; exact where the ground is a plane.
    """
    if clearances_m.min() >= 0.0:
        return 0.0
    corners = mesh.vertices_m[mesh.faces]
    one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    plan_m2 = (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]) / 2.0
    heights_m = clearances_m[mesh.faces]
    whole_m3 = float(plan_m2 @ heights_m.mean(axis=1))
    above_m3 = float(plan_m2 @ mean_above(heights_m))
    return float(np.clip(1.0 - above_m3 / whole_m3, 0.0, 1.0))


def mean_above(values: Floats) -> Floats:
    """Mean of max(z, 0) over triangles with linear z and corner values (n, 3).

    One corner z₀ > 0 over z₁, z₂ <= 0 leaves a triangle of the share z₀/(z₀ − z₁) · z₀/(z₀ − z₂)
    whose mean is z₀/3; two above are all of z plus the same of −z.
    """
    ordered = np.sort(values, axis=1)
    low, middle, high = ordered.T
    mean = ordered.mean(axis=1)
    result = np.where(low >= 0.0, mean, 0.0)
    tip = (high > 0.0) & (middle <= 0.0)
    result[tip] = _tip(high[tip], middle[tip], low[tip])
    cut = (low < 0.0) & (middle > 0.0)
    result[cut] = mean[cut] + _tip(-low[cut], -middle[cut], -high[cut])
    return np.asarray(result)


def _tip(peak: Floats, second: Floats, third: Floats) -> Floats:
    return np.asarray(peak**3 / (3.0 * (peak - second) * (peak - third)))


def shortest_turn(start: Floats, end: Floats) -> NDArray[np.float64]:
    """Rotation (3, 3) by the least angle that takes one unit vector to another."""
    cosine = float(start @ end)
    if cosine < -1.0 + 1e-12:
        helper = np.eye(3)[np.argmin(np.abs(start))]
        axis = np.cross(start, helper)
        axis /= np.linalg.norm(axis)
        return np.asarray(2.0 * np.outer(axis, axis) - np.eye(3))
    x, y, z = np.cross(start, end)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + cross + cross @ cross / (1.0 + cosine))
