"""Remeshing of rocks, fine enough to carry relief."""

import numpy as np
import trimesh
from trimesh.ray.ray_pyembree import RayMeshIntersector

from synth.arrays import Floats
from synth.errors import SpecError
from synth.geometry.mesh import Mesh, vertex_normals
from synth.rocks.record import RockModel
from synth.rocks.sphere import unit_sphere

_MIN_LOOPS = 2
_NUDGES = (0.0, 1e-5, -1e-5, 1e-4, -1e-4)  # turns of a ray that slipped through, rad


def even_mesh(rock: RockModel, *, subdivisions: int) -> Mesh:
    """Rock's surface on a mesh of about 20 × 4^subdivisions facets.

    Smooth forms are meshed anew, their vertices on the surface. A body that is known by its facets
    alone is subdivided by Loop's rule, which rounds them off. On P ⊕ B_r the vertices lie on the
    facets of its own mesh.

    Raises:
        SpecError: a body that does not surround its centroid.
    """
    if rock.remesh is not None:
        return rock.remesh(subdivisions)
    if rock.form is None:
        return _rounded_off(rock.mesh, facets=20 * 4**subdivisions)
    return resampled(rock.mesh, rock.truth.half_axes_box_m, subdivisions=subdivisions)


def _rounded_off(mesh: Mesh, *, facets: int) -> Mesh:
    """Mesh after as many of Loop's subdivisions as bring it nearest to so many facets.

    Each splits every facet in four and moves its corners towards a surface without creases
    (Loop 1987); at least two, to be rid of the facets.
    """
    times = max(_MIN_LOOPS, round(np.log(facets / len(mesh.faces)) / np.log(4.0)))
    vertices_m, faces = trimesh.remesh.subdivide_loop(mesh.vertices_m, mesh.faces, iterations=times)
    faces = np.asarray(faces, dtype=np.int64)
    return Mesh(vertices_m=vertices_m, faces=faces, normals=vertex_normals(vertices_m, faces))


def resampled(mesh: Mesh, half_axes_m: Floats, *, subdivisions: int) -> Mesh:
    """Surface that the origin's rays meet last, on an even mesh.

    The vertices lie on the mesh's facets, on rays through an even mesh of the ellipsoid with the
    half-axes. Where a ray meets the surface more than once, what lies within is left out.

    Raises:
        SpecError: a ray misses the surface.
    """
    directions, faces = unit_sphere(subdivisions)
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
        raise SpecError("rocks.relief: expected a body round its centroid, found one beside it")
    vertices_m = reach_m[:, None] * rays
    return Mesh(vertices_m=vertices_m, faces=faces, normals=vertex_normals(vertices_m, faces))


def _reach_m(mesh: Mesh, rays: Floats, surface: RayMeshIntersector, starts_m: Floats) -> Floats:
    """Distance along rays (n, 3) to the facets met on the way in, 0 if there are none."""
    towards = -starts_m / np.linalg.norm(starts_m, axis=1, keepdims=True)
    hit = np.asarray(surface.intersects_first(starts_m, towards))
    first, second, third = mesh.vertices_m[mesh.faces[hit]].transpose(1, 0, 2)
    planes = np.cross(second - first, third - first)
    along = np.einsum("ij,ij->i", planes, rays)
    known = (hit >= 0) & (along > 0.0)
    heights = np.einsum("ij,ij->i", planes, first)
    return np.where(known, heights / np.where(known, along, 1.0), 0.0)
