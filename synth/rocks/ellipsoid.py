"""Ellipsoids."""

from functools import partial

import numpy as np
from scipy.special import elliprg

from synth.arrays import Floats
from synth.geometry.mesh import Mesh
from synth.rocks.outlines import EllipsoidForm
from synth.rocks.record import RockModel
from synth.rocks.sphere import SUBDIVISIONS, unit_sphere
from synth.rocks.truth import Truth


def ellipsoid(half_axes_m: Floats) -> RockModel:
    """Solid ellipsoid with half-axes (3,), a >= b >= c.

    V = 4πabc/3; S by Carlson's symmetric integral; among orthogonal boxes round an ellipsoid,
    which all have the same diagonal (Monge), the aligned one is the smallest. Its roundness is not
    given: in Wadell's sense an ellipse's is tied to its axis ratio.
    """
    half_axes_m = np.array(half_axes_m, dtype=np.float64)
    truth = Truth(
        half_axes_box_m=half_axes_m.copy(),
        half_axes_inertia_m=half_axes_m.copy(),
        volume_m3=float(4.0 * np.pi * np.prod(half_axes_m) / 3.0),
        area_m2=ellipsoid_area_m2(half_axes_m),
        roundness=None,
    )
    return RockModel(
        family="ellipsoid",
        knobs={},
        mesh=ellipsoid_mesh(half_axes_m),
        truth=truth,
        form=EllipsoidForm(half_axes_m),
        remesh=partial(ellipsoid_mesh, half_axes_m),
    )


def ellipsoid_area_m2(half_axes_m: Floats) -> float:
    """4π R_G(a²b², a²c², b²c²), the area of an ellipsoid (DLMF 19.33.2)."""
    a2, b2, c2 = half_axes_m**2
    return float(4.0 * np.pi * elliprg(a2 * b2, a2 * c2, b2 * c2))


def ellipsoid_mesh(half_axes_m: Floats, subdivisions: int = SUBDIVISIONS) -> Mesh:
    """Mesh whose vertices lie on the ellipsoid, with its exact normals."""
    directions, faces = unit_sphere(subdivisions)
    normals = directions / half_axes_m
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return Mesh(vertices_m=directions * half_axes_m, faces=faces, normals=normals)
