"""Superellipsoids: from ellipsoid to box by two exponents."""

from functools import partial

import numpy as np

from synth.arrays import Floats
from synth.geometry.mesh import Mesh
from synth.rocks.outlines import SuperellipsoidForm
from synth.rocks.record import RockModel
from synth.rocks.sphere import unit_sphere
from synth.rocks.truth import Truth

NODES = 160  # Gauss-Legendre nodes along each of an octant's two angles
SUBDIVISIONS = 6  # 81,920 faces: with exponents up to 10 the facets take 1e-3 of the volume


def superellipsoid(half_axes_m: Floats, *, exponents: tuple[float, float]) -> RockModel:
    """Superellipsoid (|x/a|^p + |y/b|^p)^(q/p) + |z/c|^q <= 1 for exponents p, q >= 2.

    Its aligned box is the smallest: the support function is an l_P, l_Q norm of (au, bv, cw) with
    P, Q <= 2, so at least its Euclidean norm, and the product of three such norms on orthogonal
    directions is at least abc (Hadamard). It has no single radius of curvature: no roundness.
    """
    half_axes_m = np.array(half_axes_m, dtype=np.float64)
    volume_m3, area_m2, squares_m2 = integrals(half_axes_m, exponents)
    truth = Truth(
        half_axes_box_m=half_axes_m.copy(),
        half_axes_inertia_m=np.sort(np.sqrt(5.0 * squares_m2))[::-1].copy(),
        volume_m3=volume_m3,
        area_m2=area_m2,
        roundness=None,
    )
    return RockModel(
        family="superellipsoid",
        knobs={"exponent_level": exponents[0], "exponent_steep": exponents[1]},
        mesh=superellipsoid_mesh(half_axes_m, exponents),
        truth=truth,
        form=SuperellipsoidForm(half_axes_m, exponents),
        remesh=partial(superellipsoid_mesh, half_axes_m, exponents),
    )


def integrals(
    half_axes_m: Floats, exponents: tuple[float, float], *, nodes: int = NODES
) -> tuple[float, float, Floats]:
    """Volume, area and the mean of x², y², z² over the volume, (3,).

    Over directions w of the sphere, with the gauge g of the body with unit half-axes,
    V = abc ∫ g⁻³/3, S = abc ∫ |A⁻¹∇g| g⁻³ and ∫ x_i² dV = abc a_i² ∫ w_i² g⁻⁵/5 dΩ, each eight
    times an octant's, by Gauss and Legendre's rule.
    """
    node, weight = np.polynomial.legendre.leggauss(nodes)
    angle_rad, share = np.pi / 4.0 * (node + 1.0), np.pi / 4.0 * weight
    polar, azimuth = (grid.ravel() for grid in np.meshgrid(angle_rad, angle_rad, indexing="ij"))
    solid = 8.0 * (np.outer(share, share).ravel() * np.sin(polar))
    directions = np.column_stack(
        [np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)]
    )
    gauge, gradient = _gauge(directions, exponents)
    product_m3 = float(np.prod(half_axes_m))
    stretch = np.linalg.norm(gradient / half_axes_m, axis=1)
    volume_m3 = product_m3 * float(solid @ gauge**-3) / 3.0
    area_m2 = product_m3 * float((solid * stretch) @ gauge**-3)
    squares = (solid * gauge**-5) @ directions**2 / 5.0
    return volume_m3, area_m2, np.asarray(product_m3 * half_axes_m**2 * squares / volume_m3)


def _gauge(directions: Floats, exponents: tuple[float, float]) -> tuple[Floats, Floats]:
    """Gauge g(w), (n,), by which w must be divided to lie on the unit body, and ∇g, (n, 3)."""
    level, steep = exponents
    size = np.abs(directions)
    sum_level = (size[:, :2] ** level).sum(axis=1)
    radius = sum_level ** (1.0 / level)
    gauge = (radius**steep + size[:, 2] ** steep) ** (1.0 / steep)
    safe = np.maximum(radius, 1e-300)[:, None]
    ring = radius[:, None] ** (steep - 1.0) * (size[:, :2] / safe) ** (level - 1.0)
    gradient = np.column_stack([ring, size[:, 2] ** (steep - 1.0)])
    return gauge, np.sign(directions) * gradient / gauge[:, None] ** (steep - 1.0)


def superellipsoid_mesh(
    half_axes_m: Floats, exponents: tuple[float, float], subdivisions: int = SUBDIVISIONS
) -> Mesh:
    """Mesh whose vertices lie on the surface, with its exact normals."""
    directions, faces = unit_sphere(subdivisions)
    gauge, gradient = _gauge(directions, exponents)
    normals = gradient / half_axes_m
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return Mesh(vertices_m=directions / gauge[:, None] * half_axes_m, faces=faces, normals=normals)
