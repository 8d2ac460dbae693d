"""An even mesh of a surface."""

import numpy as np
import trimesh
from numpy.typing import NDArray
from trimesh.ray.ray_pyembree import RayMeshIntersector

from synth.errors import InputError
from synth.mesh import Mesh, vertex_normals
from synth.rocks.sphere import unit_sphere

Floats = NDArray[np.float64]


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
    surface = trimesh.Trimesh(mesh.vertices_m, mesh.faces, process=False)
    hit = np.asarray(RayMeshIntersector(surface).intersects_first(far_m * rays, -rays))
    if (hit < 0).any():
        raise InputError("rocks.relief: expected a body round its centroid, found one beside it")
    first, second, third = mesh.vertices_m[mesh.faces[hit]].transpose(1, 0, 2)
    planes = np.cross(second - first, third - first)
    reach_m = np.einsum("ij,ij->i", planes, first) / np.einsum("ij,ij->i", planes, rays)
    vertices_m = reach_m[:, None] * rays
    return Mesh(vertices_m=vertices_m, faces=faces, normals=vertex_normals(vertices_m, faces))
