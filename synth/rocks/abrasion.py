"""Abrasion: wear of any rock where it is convex, by mean-curvature flow of a stated amount."""

from dataclasses import replace
from functools import partial

import numpy as np
from scipy.sparse import csr_array, diags_array

from synth.arrays import Floats
from synth.geometry.mesh import (
    Mesh,
    area_m2,
    centroid_m,
    vertex_areas_m2,
    vertex_normals,
    volume_m3,
)
from synth.rocks.record import RockModel
from synth.rocks.relief import turned_to_box
from synth.rocks.resample import even_mesh, resampled

_SUBDIVISIONS = 6
_FULL = 0.3  # √(2t) at abrasion 1, over the radius of the ball of the same volume
_STEPS = 12
_STILL = 1e-9  # speed of vertices in hollows, over the others'
_FLAT = 0.2  # 2H √(area of the surface) above whose negative a place is no hollow
_TOLERANCE = 1e-7  # of the linear systems, over their right sides
_TINY = 1e-300


def abraded(rock: RockModel, *, abrasion: float) -> RockModel:
    """Rock worn by mean-curvature flow for a time t with √(2t) = 0.3 × abrasion × R.

    R is the radius of the ball of the same volume. A straight edge gets a radius of about √(2t);
    flat faces and hollows stay. Then the body is scaled alike in all directions until the longest
    side of its smallest box is what it was. The truth is the worn mesh's; its edges have no one
    radius, and it has an area where the rock had one.

    Raises:
        SpecError: a body that does not surround its centroid.
    """
    mesh = _fine_mesh(rock)
    size_m = float(np.cbrt(0.75 * volume_m3(mesh) / np.pi))
    worn = flowed(mesh, time_m2=(_FULL * abrasion * size_m) ** 2 / 2.0)
    smooth = rock.truth.relief_rms_m == 0.0
    turned, axes = turned_to_box(
        rock.family,
        worn,
        knobs={**rock.knobs, "worn": abrasion},
        relief_rms_m=0.0 if smooth else None,
        degrees=None,
    )
    factor = float(rock.truth.half_axes_box_m[0] / turned.truth.half_axes_box_m[0])
    moved = worn.moved(axes, -axes @ centroid_m(worn))
    scaled = replace(moved, vertices_m=factor * moved.vertices_m)
    area = None if rock.truth.area_m2 is None else area_m2(scaled)
    truth = turned.truth.scaled(factor, area_m2=area)
    return replace(
        turned,
        mesh=scaled,
        truth=truth,
        source=rock.source,
        remesh=partial(_remeshed, scaled, truth.half_axes_box_m),
        has_edges=rock.has_edges,
    )


def _fine_mesh(rock: RockModel) -> Mesh:
    """Even mesh of a rock; its own where facets alone tell it and they are as many."""
    known_by_facets = rock.form is None and rock.remesh is None
    if known_by_facets and len(rock.mesh.faces) >= 20 * 4**_SUBDIVISIONS:
        return rock.mesh
    return even_mesh(rock, subdivisions=_SUBDIVISIONS)


def flowed(mesh: Mesh, *, time_m2: float, steps: int = _STEPS) -> Mesh:
    """Mesh after a time of dx/dt = Δx where that points inward; elsewhere it stays.

    Δx is −2 H n, H the mean curvature. Each step is implicit, (M/μ + τ L) x' = (M/μ) x with the
    vertices' areas M, the cotangent Laplacian L of the surface before the step (negative weights
    are left out) and the mobility μ, next to nothing in hollows and else 1.

    Source: Desbrun et al. 1999, eq. 7 and 14.
    """
    vertices_m = mesh.vertices_m
    for _ in range(steps):
        now = Mesh(vertices_m, mesh.faces.copy(), vertex_normals(vertices_m, mesh.faces))
        stiffness = _cotangents(now)
        areas_m2 = vertex_areas_m2(now)
        bends_m = np.einsum("ij,ij->i", stiffness @ vertices_m, now.normals)  # 2 H areas
        hollow = bends_m * np.sqrt(areas_m2.sum()) < -_FLAT * areas_m2
        areas_m2 /= np.where(hollow, _STILL, 1.0)
        system = csr_array(diags_array(areas_m2) + time_m2 / steps * stiffness)
        vertices_m = vertices_m + _solved(system, -time_m2 / steps * (stiffness @ vertices_m))
    return Mesh(vertices_m, mesh.faces.copy(), vertex_normals(vertices_m, mesh.faces))


def _solved(system: csr_array, right: Floats) -> Floats:
    """Solution (n, 3) of a positive definite system, all columns at once.

    Conjugate gradients, preconditioned by the diagonal. Sums are numpy's own, not BLAS's: the same
    bytes with any number of threads.
    """
    weights = 1.0 / system.diagonal()[:, None]
    found, rest = np.zeros_like(right), right.copy()
    along = weights * rest
    size = (weights * rest**2).sum(axis=0)
    enough = _TOLERANCE**2 * size
    while (size > enough).any():
        image = system @ along
        step = size / np.maximum((along * image).sum(axis=0), _TINY)
        found += step * along
        rest -= step * image
        before, size = size, (weights * rest**2).sum(axis=0)
        along = weights * rest + size / np.maximum(before, _TINY) * along
    return found


def _cotangents(mesh: Mesh) -> csr_array:
    """Cotangent Laplacian (n, n), positive semidefinite, of integrated values."""
    count = len(mesh.vertices_m)
    rows, columns, weights = [], [], []
    for corner in range(3):
        apex, one, two = np.roll(mesh.faces, -corner, axis=1).T
        first = mesh.vertices_m[one] - mesh.vertices_m[apex]
        second = mesh.vertices_m[two] - mesh.vertices_m[apex]
        doubled = np.linalg.norm(np.cross(first, second), axis=1)
        rows.append(one)
        columns.append(two)
        weights.append(np.einsum("ij,ij->i", first, second) / (2.0 * doubled))
    half = csr_array(
        (np.concatenate(weights), (np.concatenate(rows), np.concatenate(columns))),
        shape=(count, count),
    )
    both = half + half.T
    both.data = np.maximum(both.data, 0.0)
    return csr_array(diags_array(both.sum(axis=1)) - both)


def _remeshed(mesh: Mesh, half_axes_m: Floats, subdivisions: int) -> Mesh:
    return resampled(mesh, half_axes_m, subdivisions=subdivisions)
