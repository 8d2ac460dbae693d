"""Exact volume, centroid and second moments of P ⊕ B_r, by integrals over its surface."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from synth.arrays import Floats
from synth.geometry.vectors import cross, length, unit_rows
from synth.rocks.polyhedron import Polyhedron, angle_rad

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)  # exact to rounding on arcs up to π


@dataclass(frozen=True, eq=False)
class Moments:
    """Volume, centroid and second central moments of a body, over its volume."""

    volume_m3: float
    centroid_m: Floats  # (3,)
    covariance_m2: Floats  # (3, 3)


def rounded_moments(polyhedron: Polyhedron, radius_m: float) -> Moments:
    """Moments of P ⊕ B_r, exact but for rounding.

    By Euler's theorem on homogeneous functions and the divergence theorem,
    V = ∮ (x·n) dS/3, ∫ x dV = ∮ x (x·n) dS/4 and ∫ x xᵀ dV = ∮ x xᵀ (x·n) dS/5. The surface is
    P's faces moved out by r, a strip of a cylinder for each edge and a part of a sphere for each
    vertex. On the strips the integrands are quadratic along the edge and trigonometric across it,
    so Gauss and Legendre's rule is exact; on the spheres they are moments of the normal.
    """
    sums = _Sums()
    for loop, normal, offset_m in zip(
        polyhedron.loops, polyhedron.normals, polyhedron.offsets_m(), strict=True
    ):
        corners_m = polyhedron.vertices_m[list(loop)] + radius_m * normal
        sums.add_facet(corners_m, normal, float(offset_m) + radius_m)
    edges = [
        _Edge((v, w), *_arc(polyhedron.normals[f], polyhedron.normals[g]))
        for v, w, f, g in polyhedron.edges()
    ]
    for edge in edges:
        sums.add_strip(polyhedron.vertices_m[list(edge.ends)], edge, radius_m)
    for vertex in range(len(polyhedron.vertices_m)):
        sums.add_cap(polyhedron.vertices_m[vertex], _cap(polyhedron, edges, vertex), radius_m)
    volume_m3 = sums.zeroth / 3.0
    centroid_m = sums.first / (4.0 * volume_m3)
    return Moments(
        volume_m3=volume_m3,
        centroid_m=centroid_m,
        covariance_m2=sums.second / (5.0 * volume_m3) - np.outer(centroid_m, centroid_m),
    )


@dataclass(frozen=True, eq=False)
class _Edge:
    """Edge of the polyhedron, and the normals between those of its two faces."""

    ends: tuple[int, int]  # vertices
    arms: Floats  # (n, 3), nodes of the great circle
    steps_rad: Floats  # (n,)


@dataclass(frozen=True, eq=False)
class _Cap:
    """The integrals over the normals u of a vertex: of 1, u, u uᵀ and u u u dΩ."""

    solid_sr: float
    first: Floats  # (3,)
    second: Floats  # (3, 3)
    third: Floats  # (3, 3, 3)


class _Sums:
    """∮ (x·n) dS, ∮ x (x·n) dS and ∮ x xᵀ (x·n) dS over what has been added."""

    def __init__(self) -> None:
        self.zeroth, self.first, self.second = 0.0, np.zeros(3), np.zeros((3, 3))

    def add_facet(self, corners_m: Floats, normal: Floats, offset_m: float) -> None:
        """Add a flat convex polygon (n, 3), a fan of triangles: x·n is its offset."""
        one, others = corners_m[0], corners_m[1:]
        for two, three in pairwise(others):
            weight = offset_m * float(normal @ cross(two - one, three - one)) / 2.0
            total = one + two + three
            squares = sum(np.outer(corner, corner) for corner in (one, two, three, total))
            self.zeroth += weight
            self.first += weight * total / 3.0
            self.second += weight * squares / 12.0

    def add_strip(self, ends_m: Floats, edge: _Edge, radius_m: float) -> None:
        """Add the cylinder's part along an edge with the ends (2, 3), between its faces."""
        arms, steps_rad = edge.arms, edge.steps_rad
        along = (_NODES[:, None] + 1.0) / 2.0
        core_m = ends_m[0] + along * (ends_m[1] - ends_m[0])
        length_m = length(ends_m[1] - ends_m[0])
        points_m = (core_m[:, None] + radius_m * arms).reshape(-1, 3)
        steps_m2 = np.outer(length_m * _WEIGHTS / 2.0, radius_m * steps_rad).ravel()
        weights = steps_m2 * np.tile(arms @ ends_m[0] + radius_m, len(_NODES))
        self.zeroth += float(weights.sum())
        self.first += weights @ points_m
        self.second += (weights[:, None] * points_m).T @ points_m

    def add_cap(self, vertex_m: Floats, cap: _Cap, radius_m: float) -> None:
        """Add the sphere's part round a vertex (3,): x = v + r u, x·n = v·u + r, dS = r² dΩ."""
        r = radius_m
        constant = float(vertex_m @ cap.first) + r * cap.solid_sr
        linear = cap.second @ vertex_m + r * cap.first
        square = cap.third @ vertex_m + r * cap.second
        self.zeroth += r**2 * constant
        self.first += r**2 * (constant * vertex_m + r * linear)
        mixed = np.outer(vertex_m, linear)
        self.second += r**2 * constant * np.outer(vertex_m, vertex_m)
        self.second += r**3 * (mixed + mixed.T) + r**4 * square


def _cap(polyhedron: Polyhedron, edges: list[_Edge], vertex: int) -> _Cap:
    """Moments of the normals at a vertex, a polygon of great circles on the sphere.

    Its solid angle is 2π less the face angles there (Descartes). The rest follow from it and the
    arcs, whose outward poles p point along the edges away from the vertex (Stokes's theorem; such
    recurrences are Arvo's of 1995):
    2 ∫ uᵢ = −∮ pᵢ, 3 ∫ uᵢuⱼ = δᵢⱼ Ω − ∮ uᵢ pⱼ, 4 ∫ uᵢuⱼuₖ = δᵢₖ ∫ uⱼ + δⱼₖ ∫ uᵢ − ∮ uᵢuⱼ pₖ.
    """
    line, mixed, triple = np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3, 3))
    for edge in edges:
        if vertex not in edge.ends:
            continue
        v, w = edge.ends
        far = w if vertex == v else v
        pole = polyhedron.vertices_m[far] - polyhedron.vertices_m[vertex]
        pole /= length(pole)
        arms, steps_rad = edge.arms, edge.steps_rad
        line += steps_rad.sum() * pole
        mixed += np.outer(steps_rad @ arms, pole)
        triple += np.einsum("n,ni,nj,k->ijk", steps_rad, arms, arms, pole)
    solid_sr = 2.0 * np.pi - sum(_face_angles_rad(polyhedron, vertex))
    first, unit = -line / 2.0, np.eye(3)
    shares = np.einsum("ik,j->ijk", unit, first) + np.einsum("jk,i->ijk", unit, first)
    return _Cap(
        solid_sr=solid_sr,
        first=first,
        second=(solid_sr * unit - mixed) / 3.0,
        third=(shares - triple) / 4.0,
    )


def _face_angles_rad(polyhedron: Polyhedron, vertex: int) -> list[float]:
    """Angles of the faces that meet at a vertex."""
    angles_rad = []
    for loop in polyhedron.loops:
        if vertex in loop:
            place = loop.index(vertex)
            ends = loop[place - 1], loop[(place + 1) % len(loop)]
            arms = polyhedron.vertices_m[list(ends)] - polyhedron.vertices_m[vertex]
            angles_rad.append(angle_rad(*unit_rows(arms)))
    return angles_rad


def _arc(start: Floats, end: Floats) -> tuple[Floats, Floats]:
    """Nodes (n, 3) and steps (n,) of the great circle between two unit vectors."""
    turn_rad = angle_rad(start, end)
    along_rad = turn_rad * (_NODES[:, None] + 1.0) / 2.0
    arms = np.sin(turn_rad - along_rad) * start + np.sin(along_rad) * end
    return arms / np.sin(turn_rad), turn_rad * _WEIGHTS / 2.0
