"""Minkowski sum of a convex polyhedron and a ball: closed forms, and an exact mesh."""

import numpy as np

from synth.arrays import Floats, Ints
from synth.geometry.mesh import Mesh
from synth.geometry.vectors import cross, length, unit_rows
from synth.rocks.polyhedron import Functionals, Polyhedron, angle_rad

_SAG_M = 5e-5  # the mesh stays this near the true surface: half a step of 0.1 mm depth
_STEPS_RAD = (0.03, 0.2)  # limits of the angle between neighbouring normals


def rounded_volume_m3(body: Functionals, radius_m: float) -> float:
    """Volume of P ⊕ B_r, V₀ + S₀r + Mr² + 4πr³/3 (Steiner)."""
    r = radius_m
    return (
        body.volume_m3 + body.area_m2 * r + body.mean_curvature_m * r**2 + 4.0 * np.pi * r**3 / 3.0
    )


def rounded_area_m2(body: Functionals, radius_m: float) -> float:
    """Area of P ⊕ B_r, S₀ + 2Mr + 4πr² (Steiner)."""
    r = radius_m
    return body.area_m2 + 2.0 * body.mean_curvature_m * r + 4.0 * np.pi * r**2


def rounded_mesh(polyhedron: Polyhedron, radius_m: float, *, split: int = 1) -> Mesh:
    """Closed mesh of P ⊕ B_r; each vertex lies on the surface and has its exact normal.

    A face moves outward by r, an edge becomes a strip of a cylinder, a vertex a spherical polygon
    whose corners are the normals of the faces that meet there. Neighbours share their vertices.
    Steps between normals may be split into several, to measure on what the facets do not flatten.
    """
    builder = _Builder(polyhedron, radius_m, split=split)
    for face, loop in enumerate(polyhedron.loops):
        builder.add_face(face, loop)
    for v, w, f, g in polyhedron.edges():
        builder.add_strip(v, w, f, g)
    builder.add_patches()
    return builder.mesh()


class _Builder:
    """Collector of the vertices and faces of one rounded polyhedron."""

    def __init__(self, polyhedron: Polyhedron, radius_m: float, *, split: int) -> None:
        step_rad = 2.0 * np.sqrt(2.0 * _SAG_M / radius_m)
        self._step_rad = float(np.clip(step_rad, *_STEPS_RAD)) / split
        self._body = polyhedron
        self._radius_m = radius_m
        self._count = 0
        self._owners: list[Ints] = []  # the polyhedron's vertex under each vertex of the mesh
        self._normals: list[Floats] = []
        self._faces: list[Ints] = []
        self._corners: dict[tuple[int, int], int] = {}
        self._arcs: dict[tuple[int, int, int], Ints] = {}
        self._directions: dict[tuple[int, int], Floats] = {}

    def add_face(self, face: int, loop: tuple[int, ...]) -> None:
        """Add a flat face, moved outward, as a fan."""
        corners = np.array([self._corner(vertex, face) for vertex in loop])
        hub = np.full(len(corners) - 2, corners[0])
        self._faces.append(np.column_stack([hub, corners[1:-1], corners[2:]]))

    def add_strip(self, v: int, w: int, f: int, g: int) -> None:
        """Add the cylinder's part along the edge v–w between the faces f and g."""
        at_v, at_w = self._arc(v, f, g), self._arc(w, f, g)
        self._faces.append(np.column_stack([at_w[:-1], at_v[:-1], at_v[1:]]))
        self._faces.append(np.column_stack([at_w[:-1], at_v[1:], at_w[1:]]))

    def add_patches(self) -> None:
        """Add each vertex's spherical polygon, after the strips, which its rim runs along."""
        rounds = [self._faces_round(vertex) for vertex in range(len(self._body.vertices_m))]
        loops = [
            np.concatenate(
                [
                    self._arc(vertex, f, g)[:-1]
                    for f, g in zip(faces, (*faces[1:], faces[0]), strict=True)
                ]
            )
            for vertex, faces in enumerate(rounds)
        ]
        normals = np.concatenate(self._normals)
        for vertex, (faces, loop) in enumerate(zip(rounds, loops, strict=True)):
            self._add_patch(vertex, faces, loop, normals[loop])

    def _add_patch(self, vertex: int, faces: list[int], loop: Ints, rim: Floats) -> None:
        """Add a spherical polygon with the normals of its rim: rings that shrink to its middle."""
        middle = self._body.normals[faces].sum(axis=0)
        middle /= length(middle)
        reach_rad = max(angle_rad(middle, normal) for normal in self._body.normals[faces])
        rings = max(1, int(np.ceil(reach_rad / self._step_rad)))
        share = (np.arange(1, rings) / rings)[:, None, None]
        inner = self._add(vertex, (rim + share * (middle - rim)).reshape(-1, 3))
        layers = np.vstack([loop, inner.reshape(-1, len(loop))])
        after = np.roll(layers, -1, axis=1)
        one = np.stack([layers[:-1], after[:-1], after[1:]], axis=-1)
        two = np.stack([layers[:-1], after[1:], layers[1:]], axis=-1)
        self._faces.append(np.stack([one, two], axis=1).reshape(-1, 3))
        top = np.repeat(self._add(vertex, middle[None]), len(loop))
        self._faces.append(np.column_stack([layers[-1], after[-1], top]))

    def mesh(self) -> Mesh:
        """Mesh of what has been collected."""
        normals = np.concatenate(self._normals)
        cores_m = self._body.vertices_m[np.concatenate(self._owners)]
        return Mesh(
            vertices_m=cores_m + self._radius_m * normals,
            faces=np.concatenate(self._faces),
            normals=normals,
        )

    def _add(self, vertex: int, directions: Floats) -> Ints:
        """Add mesh vertices round a vertex of the polyhedron; return their indices."""
        self._normals.append(unit_rows(directions))
        self._owners.append(np.full(len(directions), vertex))
        added = np.arange(self._count, self._count + len(directions))
        self._count += len(directions)
        return added

    def _corner(self, vertex: int, face: int) -> int:
        if (vertex, face) not in self._corners:
            added = self._add(vertex, self._body.normals[face][None])
            self._corners[vertex, face] = int(added[0])
        return self._corners[vertex, face]

    def _arc(self, vertex: int, f: int, g: int) -> Ints:
        """Vertices from face f's normal to face g's, along the great circle."""
        if (vertex, f, g) not in self._arcs:
            ends = self._corner(vertex, f), self._corner(vertex, g)
            arc = np.concatenate([ends[:1], self._add(vertex, self._between(f, g)), ends[1:]])
            self._arcs[vertex, f, g] = arc
            self._arcs[vertex, g, f] = arc[::-1]
        return self._arcs[vertex, f, g]

    def _between(self, f: int, g: int) -> Floats:
        """Directions between two faces' normals without the ends, alike at both ends of an edge."""
        if (f, g) not in self._directions:
            start, end = self._body.normals[f], self._body.normals[g]
            turn_rad = angle_rad(start, end)
            pieces = max(1, int(np.ceil(turn_rad / self._step_rad)))
            along_rad = turn_rad * np.arange(1, pieces)[:, None] / pieces
            self._directions[f, g] = np.sin(turn_rad - along_rad) * start + np.sin(along_rad) * end
        return self._directions[f, g]

    def _faces_round(self, vertex: int) -> list[int]:
        """Faces that meet at a vertex, anticlockwise seen from outside."""
        faces = [face for face, loop in enumerate(self._body.loops) if vertex in loop]
        normals = self._body.normals[faces]
        middle = normals.sum(axis=0)
        middle /= length(middle)
        arms = normals - np.outer(normals @ middle, middle)
        across = cross(middle, arms[0])
        turn_rad = np.arctan2(arms @ across, arms @ cross(across, middle))
        return [faces[index] for index in np.argsort(turn_rad)]
