"""Convex polyhedra as intersections of half-spaces, with their exact V, S and M."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, HalfspaceIntersection, QhullError

from synth.arrays import Floats
from synth.errors import SpecError
from synth.geometry.inscribed_ball import InscribedBall, largest_ball
from synth.geometry.vectors import cross, length, unit_rows

_DRAWS = 12  # candidates for each cut; the one farthest from the cuts so far is kept
_ATTEMPTS = 100


@dataclass(frozen=True, eq=False)
class Polyhedron:
    """Convex polyhedron that holds the origin."""

    vertices_m: Floats  # (n, 3)
    loops: tuple[tuple[int, ...], ...]  # a face's vertices, anticlockwise seen from outside
    normals: Floats  # (faces, 3), outward, of length 1

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        self.vertices_m.setflags(write=False)
        self.normals.setflags(write=False)

    def offsets_m(self) -> Floats:
        """Each face's distance from the origin along its normal, (faces,)."""
        anchors = self.vertices_m[[loop[0] for loop in self.loops]]
        return np.asarray(np.einsum("ij,ij->i", anchors, self.normals))

    def edges(self) -> list[tuple[int, int, int, int]]:
        """Edges (v, w, f, g): face f runs it from v to w, face g from w to v."""
        owner = {
            (v, w): face
            for face, loop in enumerate(self.loops)
            for v, w in zip(loop, (*loop[1:], loop[0]), strict=True)
        }
        return [(v, w, f, owner[w, v]) for (v, w), f in owner.items() if v < w]

    def mapped(self, matrix: Floats) -> "Polyhedron":
        """Image under a linear map (3, 3) of positive determinant."""
        normals = self.normals @ np.linalg.inv(matrix)
        return Polyhedron(
            vertices_m=self.vertices_m @ matrix.T,
            loops=self.loops,
            normals=unit_rows(normals),
        )

    def shifted(self, shift_m: Floats) -> "Polyhedron":
        """Polyhedron moved by a vector (3,)."""
        return Polyhedron(
            vertices_m=self.vertices_m + shift_m, loops=self.loops, normals=self.normals.copy()
        )


@dataclass(frozen=True)
class Functionals:
    """Minkowski functionals, from which Steiner's formula takes volume and area of P ⊕ B_r."""

    volume_m3: float
    area_m2: float
    mean_curvature_m: float  # M = ½ Σ edge length × exterior angle


def from_half_spaces(normals: Floats, offsets_m: Floats) -> Polyhedron:
    """Polyhedron {x : n·x <= h for each half-space}, from unit normals (k, 3) and offsets (k,) > 0.

    A half-space that cuts nothing off leaves no face.

    Raises:
        SpecError: the half-spaces leave the body unbounded.
    """
    if not _surround_origin(normals):
        raise SpecError("half-spaces: expected a bounded body, found an open one")
    half_spaces = np.column_stack([normals, -offsets_m])
    points_m = HalfspaceIntersection(half_spaces, np.zeros(3)).intersections
    size_m = float(np.abs(points_m).max())
    vertices_m = _distinct(points_m, tolerance_m=1e-9 * size_m)
    on_plane = np.abs(vertices_m @ normals.T - offsets_m) < 1e-7 * size_m
    faces = [face for face in range(len(normals)) if on_plane[:, face].sum() >= 3]
    loops = tuple(
        _loop(vertices_m, np.flatnonzero(on_plane[:, face]), normals[face]) for face in faces
    )
    return Polyhedron(vertices_m=vertices_m, loops=loops, normals=normals[faces].copy())


def tangent_cuts(half_axes_m: Floats, *, cuts: int, rng: np.random.Generator) -> Polyhedron:
    """Polyhedron whose faces all touch an ellipsoid, in random but spread directions.

    The unit ball's tangent planes are drawn one by one, each the farthest of a few from those
    before it; the ball is then stretched, and tangency survives the stretch.

    Raises:
        SpecError: so few cuts that no bounded body of decent proportions came up.
    """
    for _ in range(_ATTEMPTS):
        normals = spread_normals(cuts, rng)
        try:
            ball = from_half_spaces(normals, np.ones(cuts))
        except SpecError:
            continue
        if np.linalg.norm(ball.vertices_m, axis=1).max() < 2.0:
            return ball.mapped(np.diag(half_axes_m))
    raise SpecError(f"rocks.cuts: expected enough to bound a rock, found {cuts}")


def cuboid(half_axes_m: Floats) -> Polyhedron:
    """Box with the given half sides (3,) along the axes."""
    normals = np.concatenate([np.eye(3), -np.eye(3)])
    return from_half_spaces(normals, np.concatenate([half_axes_m, half_axes_m]))


def functionals(polyhedron: Polyhedron) -> Functionals:
    """Volume, area and integral mean curvature, all exact."""
    areas_m2 = np.array([_face_area_m2(polyhedron, face) for face in range(len(polyhedron.loops))])
    bend_m = 0.0
    for v, w, f, g in polyhedron.edges():
        length_m = length(polyhedron.vertices_m[w] - polyhedron.vertices_m[v])
        bend_m += length_m * angle_rad(polyhedron.normals[f], polyhedron.normals[g])
    return Functionals(
        volume_m3=float(polyhedron.offsets_m() @ areas_m2 / 3.0),
        area_m2=float(areas_m2.sum()),
        mean_curvature_m=bend_m / 2.0,
    )


def inscribed_ball(
    polyhedron: Polyhedron, *, likely: NDArray[np.int64] | None = None
) -> InscribedBall:
    """Largest ball inside; `likely` are the faces that touch it in a similar polyhedron."""
    return largest_ball(polyhedron.normals, polyhedron.offsets_m(), likely=likely)


def angle_rad(first: Floats, second: Floats) -> float:
    """Angle between two unit vectors, accurate when it is small."""
    return float(np.arctan2(length(cross(first, second)), first @ second))


def _surround_origin(normals: Floats) -> bool:
    """Whether the origin is inside the hull of the normals: the half-spaces then close."""
    try:
        return bool((ConvexHull(normals).equations[:, 3] < -1e-9).all())
    except QhullError:
        return False


def spread_normals(count: int, rng: np.random.Generator) -> Floats:
    """Unit vectors, (count, 3): each the best of a few (Mitchell 1991)."""
    chosen = np.empty((count, 3))
    for index in range(count):
        candidates = rng.standard_normal((_DRAWS, 3))
        candidates = unit_rows(candidates)
        nearest = (candidates @ chosen[:index].T).max(axis=1, initial=-1.0)
        chosen[index] = candidates[np.argmin(nearest)]
    return chosen


def _distinct(points_m: Floats, *, tolerance_m: float) -> Floats:
    """Points that are no copy of an earlier one."""
    kept: list[Floats] = []
    for point in points_m:
        if all(np.abs(point - other).max() > tolerance_m for other in kept):
            kept.append(point)
    return np.array(kept)


def _loop(vertices_m: Floats, members: NDArray[np.intp], normal: Floats) -> tuple[int, ...]:
    """Convex face's vertices in order round its normal."""
    arms = vertices_m[members] - vertices_m[members].mean(axis=0)
    across = cross(normal, arms[0])
    turn_rad = np.arctan2(arms @ across, arms @ cross(across, normal))
    return tuple(int(member) for member in members[np.argsort(turn_rad)])


def _face_area_m2(polyhedron: Polyhedron, face: int) -> float:
    corners = polyhedron.vertices_m[list(polyhedron.loops[face])]
    doubled = np.cross(corners, np.roll(corners, -1, axis=0)).sum(axis=0)
    return float(polyhedron.normals[face] @ doubled / 2.0)
