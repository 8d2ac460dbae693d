"""An even mesh of a surface."""

import numpy as np
import trimesh
from numpy.typing import NDArray
from trimesh.ray.ray_pyembree import RayMeshIntersector

from synth.errors import InputError
from synth.mesh import Mesh, vertex_normals
from synth.rocks.sphere import unit_sphere

Floats = NDArray[np.float64]

_NUDGES = (0.0, 1e-5, -1e-5, 1e-4, -1e-4)  # turns of a ray that slipped through, rad


def resampled(mesh: Mesh, half_axes_m: Floats, *, subdivisions: int) -> Mesh:
    """Return the surface that the origin's rays meet last, on an even mesh.

    The vertices lie on the mesh's facets, on rays through an even mesh of the ellipsoid with the
    half-axes. Where a ray meets the surface more than once, what lies within is left out.

    Raises:
        InputError: a ray misses the surface.
    """
    directions, faces = unit_sphere(subdivisions)
    if len(mesh.vertices_m) == len(directions):
        return mesh  # it was made from this very sphere
    rays = directions * half_axes_m
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    far_m = 2.0 * float(np.linalg.norm(mesh.vertices_m, axis=1).max())
    surface = RayMeshIntersector(trimesh.Trimesh(mesh.vertices_m, mesh.faces, process=False))
    reach_m = np.full(len(rays), -1.0)
    for nudge in _NUDGES:
        # A ray may slip through between two facets and hit the far side, or nothing.
        missed = np.flatnonzero(reach_m <= 0.0)
        starts_m = far_m * (rays[missed] + nudge)
        reach_m[missed] = _reach_m(mesh, rays[missed], surface, starts_m)
    if (reach_m <= 0.0).any():
        raise InputError("rocks.relief: expected a body round its centroid, found one beside it")
    vertices_m = reach_m[:, None] * rays
    return Mesh(vertices_m=vertices_m, faces=faces, normals=vertex_normals(vertices_m, faces))


def _reach_m(mesh: Mesh, rays: Floats, surface: RayMeshIntersector, starts_m: Floats) -> Floats:
    """Return how far along rays (n, 3) the facets lie that are met on the way in, 0 if none."""
    towards = -starts_m / np.linalg.norm(starts_m, axis=1, keepdims=True)
    hit = np.asarray(surface.intersects_first(starts_m, towards))
    first, second, third = mesh.vertices_m[mesh.faces[hit]].transpose(1, 0, 2)
    planes = np.cross(second - first, third - first)
    along = np.einsum("ij,ij->i", planes, rays)
    known = (hit >= 0) & (along > 0.0)
    heights = np.einsum("ij,ij->i", planes, first)
    return np.where(known, heights / np.where(known, along, 1.0), 0.0)
