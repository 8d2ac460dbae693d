"""Star-shaped surface of several parts, meshed so that facets' edges run along the creases."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats, Ints
from synth.geometry.mesh import Mesh, half_edges, vertex_normals
from synth.rocks.sphere import unit_sphere

_BISECTIONS = 14  # of an edge: 1e-4 of its length
_REACH = 0.505  # share of an edge that a vertex may move along it: to its middle, if need be
_NONE = np.zeros((0, 3))


class StarSurface(Protocol):
    """Surface round the origin, known along each direction."""

    def points(self, directions: Floats) -> tuple[Floats, Ints]:
        """Points (n, 3) of the surface, one for each direction (n, 3), and their parts (n,).

        Where the part changes the surface may have a crease.
        """


@dataclass(frozen=True, eq=False)
class EvenPoints:
    """Points of a surface along the directions of an even mesh of the sphere."""

    subdivisions: int
    points: Floats  # (n, 3)
    parts: Ints  # (n,)


def even_points(surface: StarSurface, subdivisions: int) -> EvenPoints:
    """Points of a surface along the directions of `unit_sphere(subdivisions)`."""
    return EvenPoints(subdivisions, *surface.points(unit_sphere(subdivisions)[0]))


def star_mesh(
    surface: StarSurface,
    subdivisions: int,
    *,
    through: Floats = _NONE,
    known: EvenPoints | None = None,
) -> Mesh:
    """Mesh of 20 × 4^subdivisions facets, its vertices on the surface, some on its creases.

    The vertices nearest to the directions (k, 3) that it goes `through` are moved there. Points of
    the surface that are known are not computed again where they are as fine as the mesh.
    """
    if known is None or known.subdivisions != subdivisions:
        known = even_points(surface, subdivisions)
    even, faces = unit_sphere(subdivisions)
    directions, parts = even, known.parts
    if (parts != parts[0]).any():
        directions = _creased(surface, directions, faces, parts)
    directions = _through(directions, faces, through)
    moved = (directions != even).any(axis=1)
    vertices, faces = known.points.copy(), faces.copy()
    if moved.any():
        vertices[moved], _ = surface.points(directions[moved])
    return Mesh(vertices_m=vertices, faces=faces, normals=vertex_normals(vertices, faces))


def _creased(surface: StarSurface, directions: Floats, faces: Ints, parts: Ints) -> Floats:
    """Directions (n, 3), those next to a change of part moved onto it along an edge.

    A vertex goes to the nearest change on its edges, no farther than the edge's middle; in facets
    that this would turn over it stays.
    """
    edges = half_edges(faces)
    edges = edges[parts[edges[:, 0]] != parts[edges[:, 1]]]  # each from both of its ends
    starts, ends = directions[edges[:, 0]], directions[edges[:, 1]]
    low, high = np.zeros(len(edges)), np.ones(len(edges))
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2.0
        same = surface.points(_between(starts, ends, middle))[1] == parts[edges[:, 0]]
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    order = np.argsort(-high, kind="stable")  # of a vertex's edges the nearest change comes last
    order = order[high[order] < _REACH]
    moved = directions.copy()
    moved[edges[order, 0]] = _between(starts[order], ends[order], high[order])
    folded = _turned_over(moved, faces)
    while folded.any():
        moved[faces[folded]] = directions[faces[folded]]
        folded = _turned_over(moved, faces)
    return moved


def _through(directions: Floats, faces: Ints, wanted: Floats) -> Floats:
    """Directions (n, 3), the nearest to each wanted one (k, 3) moved there.

    One that would turn a facet over stays.
    """
    moved = directions.copy()
    for way in wanted:
        nearest = int(np.argmax(directions @ way))
        moved[nearest] = way
        if _turned_over(moved, faces[(faces == nearest).any(axis=1)]).any():
            moved[nearest] = directions[nearest]
    return moved


def _between(starts: Floats, ends: Floats, shares: Floats) -> Floats:
    """Directions (n, 3) at shares (n,) of the ways from one to another."""
    mixed = starts + shares[:, None] * (ends - starts)
    return np.asarray(mixed / np.linalg.norm(mixed, axis=1, keepdims=True))


def _turned_over(directions: Floats, faces: Ints) -> NDArray[np.bool_]:
    one, two, three = directions[faces].transpose(1, 0, 2)
    return np.asarray(np.einsum("ij,ij->i", np.cross(one, two), three) <= 0.0)
