"""Rough rocks: a band of relief of exact RMS along the normals of an ellipsoid."""

import numpy as np
from numpy.typing import NDArray

from synth.mesh import Mesh, area_m2, centroid_m, covariance_m2, vertex_normals, volume_m3
from synth.rocks.ellipsoid import ellipsoid_mesh, unit_sphere
from synth.rocks.record import Rock
from synth.truth import Truth, half_axes_of_covariance_m, smallest_box

Floats = NDArray[np.float64]


def perturbed(
    half_axes_m: Floats, *, relief_rms: float, degrees: tuple[int, int], rng: np.random.Generator
) -> Rock:
    """Return an ellipsoid with relief, turned into its own smallest box.

    The relief's RMS over the smooth surface is relief_rms × (abc)^(1/3), exactly. The half-axes
    and the volume are the rough body's own; its area and roundness have no truth.
    """
    smooth = ellipsoid_mesh(half_axes_m)
    weights_m2 = vertex_areas_m2(smooth)
    relief = band_limited(unit_sphere()[0], degrees=degrees, rng=rng)
    relief -= weights_m2 @ relief / weights_m2.sum()
    rms_m = relief_rms * float(np.cbrt(np.prod(half_axes_m)))
    relief_m = relief * rms_m / np.sqrt(weights_m2 @ relief**2 / weights_m2.sum())
    vertices_m = smooth.vertices_m + relief_m[:, None] * smooth.normals
    faces = smooth.faces.copy()
    rough = Mesh(vertices_m=vertices_m, faces=faces, normals=vertex_normals(vertices_m, faces))
    box = smallest_box(vertices_m)
    truth = Truth(
        half_axes_box_m=box.half_sides_m,
        half_axes_inertia_m=half_axes_of_covariance_m(covariance_m2(rough)),
        volume_m3=volume_m3(rough),
        area_m2=None,
        roundness=None,
    )
    return Rock(
        family="perturbed",
        knobs={
            "relief_rms": relief_rms,
            "relief_rms_m": rms_m,
            "degree_low": float(degrees[0]),
            "degree_high": float(degrees[1]),
            "mesh_area_m2": area_m2(rough),
        },
        mesh=rough.moved(box.axes, -box.axes @ centroid_m(rough)),
        truth=truth,
    )


def band_limited(
    directions: Floats, *, degrees: tuple[int, int], rng: np.random.Generator
) -> Floats:
    """Return a random function on the sphere, (n,), of the given degrees alone.

    Degree l is Σⱼ wⱼ P_l(u·ωⱼ) over 2l + 1 random poles ωⱼ, with the weights' variance 1/(2l + 1)
    and the degree's amplitude 1/l, so that coarse relief outweighs fine.
    """
    total = np.zeros(len(directions))
    for degree in range(degrees[0], degrees[1] + 1):
        poles = rng.standard_normal((2 * degree + 1, 3))
        poles /= np.linalg.norm(poles, axis=1, keepdims=True)
        weights = rng.standard_normal(2 * degree + 1) / (degree * np.sqrt(2 * degree + 1))
        total += _legendre(degree, directions @ poles.T) @ weights
    return total


def vertex_areas_m2(mesh: Mesh) -> Floats:
    """Return each vertex's share of the area, (n,): a third of the faces round it."""
    corners = mesh.vertices_m[mesh.faces]
    areas = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    shares = np.repeat(areas / 6.0, 3)
    sums = np.bincount(mesh.faces.ravel(), weights=shares, minlength=len(mesh.vertices_m))
    return sums.astype(np.float64)


def _legendre(degree: int, cosine: Floats) -> Floats:
    """Return P_l by Bonnet's recursion."""
    before, now = np.ones_like(cosine), cosine
    for k in range(1, degree):
        before, now = now, ((2 * k + 1) * cosine * now - k * before) / (k + 1)
    return now
