"""Pebbles: stones too small to count, which belong to the ground."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from synth.arrays import Floats
from synth.errors import SpecError
from synth.geometry.mesh import Mesh, vertex_normals
from synth.spec.ground import GroundSpec

_MAX_PEBBLES = 60_000
_CORNERS = 22
_SHAPES = 12
_STEEPNESS = 3.0  # numbers fall as diameter^−3, as in the smallest sizes of rock counts
_MIN_AXIS = 0.5


def pebbles(
    spec: GroundSpec,
    heights_m: Callable[[Floats], Floats],
    *,
    radius_m: float,
    rng: np.random.Generator,
) -> Mesh | None:
    """All pebbles on a disc as one mesh, or None where the spec wants none.

    Each is the hull of a few points on an ellipsoid, stretched, turned and sunk by half or so.

    Raises:
        SpecError: too many.
    """
    count = round(spec.pebbles_per_m2 * np.pi * radius_m**2)
    if count == 0:
        return None
    if count > _MAX_PEBBLES:
        raise SpecError(
            f"ground.pebbles_per_m2: expected at most {_MAX_PEBBLES} pebbles on a disc of "
            f"{radius_m:g} m, found {count}"
        )
    shapes = [_shape(rng) for _ in range(_SHAPES)]
    low, high = (value ** (1.0 - _STEEPNESS) for value in spec.pebble_diameter_m)
    sizes_m = rng.uniform(high, low, size=count) ** (1.0 / (1.0 - _STEEPNESS))
    reach_m = radius_m * np.sqrt(rng.uniform(size=count))
    azimuths_rad = rng.uniform(0.0, 2.0 * np.pi, size=count)
    places_m = reach_m[:, None] * np.column_stack([np.cos(azimuths_rad), np.sin(azimuths_rad)])
    heights = heights_m(places_m)
    yaws_rad = rng.uniform(0.0, 2.0 * np.pi, size=count)
    turns = Rotation.from_rotvec(np.outer(yaws_rad, [0.0, 0.0, 1.0])).as_matrix()
    sunk = rng.uniform(-0.3, 0.3, size=count)
    vertices, faces, start = [], [], 0
    for index in range(count):
        points, triangles = shapes[index % _SHAPES]
        body = sizes_m[index] / 2.0 * (points @ turns[index].T)
        body += np.array([*places_m[index], heights[index] - sunk[index] * sizes_m[index] / 2.0])
        vertices.append(body)
        faces.append(triangles + start)
        start += len(points)
    vertices_m, all_faces = np.concatenate(vertices), np.concatenate(faces)
    normals = vertex_normals(vertices_m, all_faces)
    return Mesh(vertices_m=vertices_m, faces=all_faces, normals=normals)


def _shape(rng: np.random.Generator) -> tuple[Floats, NDArray[np.int64]]:
    """Stone's corners, (n, 3) with longest half-axis 1 or less, and outward faces."""
    points = rng.standard_normal((_CORNERS, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    points *= np.sort(rng.uniform(_MIN_AXIS, 1.0, size=3))[::-1]
    hull = ConvexHull(points)
    faces = hull.simplices.astype(np.int64)
    corners = points[faces]
    outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inverted = np.einsum("ij,ij->i", outward, hull.equations[:, :3]) < 0.0
    faces[inverted] = faces[inverted][:, ::-1]
    used = np.unique(faces)
    return points[used], np.searchsorted(used, faces)
