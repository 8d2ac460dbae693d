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
_FALL = 1.5  # power of the distance with which the least diameter grows outside of the disc


def pebbles(
    spec: GroundSpec,
    heights_m: Callable[[Floats], Floats],
    *,
    radius_m: float,
    rng: np.random.Generator,
    beyond: bool = False,
) -> Mesh | None:
    """All pebbles on a disc as one mesh, or None where the spec wants none.

    Each is the hull of a few points on an ellipsoid, stretched, turned and sunk by half or so.
    With `beyond` there are some outside of the disc too, the farther the larger the least of
    them, as distance^1.5, so that those the eye can tell apart do not end at its edge; where
    there would be more than 60,000 in all, the smallest are left out.

    Raises:
        SpecError: too many.
    """
    low_m, high_m = spec.pebble_diameter_m
    expected = spec.pebbles_per_m2 * np.pi * radius_m**2
    inside, outside = _counts(expected, low_m / high_m, beyond=beyond)
    if beyond and inside + outside > _MAX_PEBBLES:
        share = _MAX_PEBBLES / (inside + outside + 2)
        low_m = float(_exceeded_m(share, low_m, high_m))
        inside, outside = _counts(expected * share, low_m / high_m, beyond=beyond)
    count = inside + outside
    if count == 0:
        return None
    if count > _MAX_PEBBLES:
        raise SpecError(
            f"ground.pebbles_per_m2: expected at most {_MAX_PEBBLES} pebbles on a disc of "
            f"{radius_m:g} m, found {count}"
        )
    shapes = [_shape(rng) for _ in range(_SHAPES)]
    sizes_m = _exceeded_m(rng.uniform(size=inside), low_m, high_m)
    reach_m = radius_m * np.sqrt(rng.uniform(size=inside))
    azimuths_rad = rng.uniform(0.0, 2.0 * np.pi, size=inside)
    if outside:
        far = 1.0 / rng.uniform(_nearness(low_m / high_m), 1.0, size=outside)
        shares = rng.uniform(size=outside)
        sizes_m = np.concatenate([sizes_m, _exceeded_m(shares, low_m * far**_FALL, high_m)])
        reach_m = np.concatenate([reach_m, radius_m * far])
        turns_rad = rng.uniform(0.0, 2.0 * np.pi, size=outside)
        azimuths_rad = np.concatenate([azimuths_rad, turns_rad])
    places_m = reach_m[:, None] * np.column_stack([np.cos(azimuths_rad), np.sin(azimuths_rad)])
    heights = heights_m(places_m)
    yaws_rad = rng.uniform(0.0, 2.0 * np.pi, size=count)
    turns = Rotation.from_rotvec(np.outer(yaws_rad, [0.0, 0.0, 1.0])).as_matrix()
    sunk = rng.uniform(-0.3, 0.3, size=count)
    middles_m = np.column_stack([places_m, heights - sunk * sizes_m / 2.0])
    vertices_m, all_faces = _bodies(shapes, sizes_m / 2.0, turns, middles_m)
    normals = vertex_normals(vertices_m, all_faces)
    return Mesh(vertices_m=vertices_m, faces=all_faces, normals=normals)


def _bodies(
    shapes: list[tuple[Floats, NDArray[np.int64]]],
    halves_m: Floats,
    turns: Floats,
    middles_m: Floats,
) -> tuple[Floats, NDArray[np.int64]]:
    """Vertices and faces of stones, the shapes in turn, of half sizes (n,) at middles (n, 3)."""
    shape = np.arange(len(halves_m)) % _SHAPES
    starts = np.cumsum([0, *(len(shapes[one][0]) for one in shape)])
    first = np.cumsum([0, *(len(shapes[one][1]) for one in shape)])
    vertices_m = np.empty((starts[-1], 3))
    faces = np.empty((first[-1], 3), dtype=np.int64)
    for number, (points, triangles) in enumerate(shapes):
        here = np.flatnonzero(shape == number)
        bodies = halves_m[here, None, None] * (points @ turns[here].transpose(0, 2, 1))
        rows = starts[here][:, None] + np.arange(len(points))
        vertices_m[rows] = bodies + middles_m[here, None]
        cells = first[here][:, None] + np.arange(len(triangles))
        faces[cells] = triangles + starts[here][:, None, None]
    return vertices_m, faces


def _counts(expected: float, ratio: float, *, beyond: bool) -> tuple[int, int]:
    """Numbers of pebbles on the disc and outside, of the least diameter over the greatest."""
    return round(expected), round(2.0 * expected * (1.0 - _nearness(ratio))) if beyond else 0


def _nearness(ratio: float) -> float:
    """Radius of the disc over the farthest pebble's distance."""
    return float(ratio ** (1.0 / _FALL))


def _exceeded_m(shares: Floats | float, least_m: Floats | float, most_m: float) -> Floats:
    """Diameters that these shares of pebbles exceed, of those between a least and the most."""
    power = 1.0 - _STEEPNESS
    least, most = np.asarray(least_m) ** power, most_m**power
    return np.asarray((most + (least - most) * shares) ** (1.0 / power))


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
