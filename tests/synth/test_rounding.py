"""Rounded bodies: Steiner's formula against the mesh, closed surfaces, held axes."""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from synth.errors import SpecError
from synth.geometry.mesh import area_m2, volume_m3
from synth.rocks.polyhedron import (
    cuboid,
    from_half_spaces,
    functionals,
    inscribed_ball,
    tangent_cuts,
)
from synth.rocks.rounded import rounded_box
from synth.rocks.rounding import rounded_area_m2, rounded_mesh, rounded_volume_m3

HALF_AXES_M = np.array([0.2, 0.15, 0.1])


def test_box_functionals_are_the_closed_forms():
    # M of a box is π (a + b + c) with half sides a, b, c: 12 edges at π/2. Rounding only: 1e-12.
    body = functionals(cuboid(HALF_AXES_M))
    a, b, c = HALF_AXES_M
    assert body.volume_m3 == pytest.approx(8 * a * b * c, rel=1e-12)
    assert body.area_m2 == pytest.approx(8 * (a * b + b * c + c * a), rel=1e-12)
    assert body.mean_curvature_m == pytest.approx(2 * np.pi * (a + b + c), rel=1e-12)


def test_tiny_core_is_a_ball():
    # P of a tenth of a micrometre: V and S of the ball, off by the core's share, 1e-5.
    body = functionals(cuboid(np.full(3, 1e-7)))
    assert rounded_volume_m3(body, 0.1) == pytest.approx(4 * np.pi * 0.1**3 / 3, rel=1e-5)
    assert rounded_area_m2(body, 0.1) == pytest.approx(4 * np.pi * 0.1**2, rel=1e-5)


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 10_000), share=st.floats(0.02, 0.8))
def test_mesh_is_closed_and_has_the_exact_volume_and_area(seed, share):
    polyhedron = tangent_cuts(HALF_AXES_M, cuts=13, rng=np.random.default_rng(seed))
    radius_m = share * inscribed_ball(polyhedron).radius_m
    mesh = rounded_mesh(polyhedron, radius_m)
    surface = trimesh.Trimesh(mesh.vertices_m, mesh.faces, process=False)
    assert surface.is_watertight
    assert surface.is_winding_consistent
    # The vertices lie on the surface, the facets up to 0.05 mm inside: 0.05 mm × S / V is
    # 1e-3 at most for rocks of this size.
    body = functionals(polyhedron)
    assert volume_m3(mesh) == pytest.approx(rounded_volume_m3(body, radius_m), rel=1e-3)
    assert volume_m3(mesh) < rounded_volume_m3(body, radius_m)
    assert area_m2(mesh) == pytest.approx(rounded_area_m2(body, radius_m), rel=1e-3)


def test_vertices_are_support_points_of_their_normals():
    # h(u) of P ⊕ B_r is h_P(u) + r, attained at the vertex whose normal is u. Rounding: 1e-12 m.
    polyhedron = tangent_cuts(HALF_AXES_M, cuts=12, rng=np.random.default_rng(3))
    mesh = rounded_mesh(polyhedron, 0.02)
    support_m = (polyhedron.vertices_m @ mesh.normals.T).max(axis=0) + 0.02
    np.testing.assert_allclose(
        np.einsum("ij,ij->i", mesh.vertices_m, mesh.normals), support_m, atol=1e-12
    )


def test_cuts_touch_the_ellipsoid():
    # Tangency: the offset of a plane is the ellipsoid's support, |A n|. Rounding: 1e-12.
    polyhedron = tangent_cuts(HALF_AXES_M, cuts=14, rng=np.random.default_rng(5))
    support_m = np.linalg.norm(polyhedron.normals * HALF_AXES_M, axis=1)
    np.testing.assert_allclose(polyhedron.offsets_m(), support_m, rtol=1e-12)


def test_euler_and_edges():
    polyhedron = tangent_cuts(HALF_AXES_M, cuts=14, rng=np.random.default_rng(6))
    count = len(polyhedron.vertices_m) - len(polyhedron.edges()) + len(polyhedron.loops)
    assert count == 2


def test_box_and_ball_truth():
    # Box ⊕ ball: V by slabs, quarter cylinders and a ball; exact to rounding.
    rock = rounded_box(HALF_AXES_M, rounding=0.5)
    r = rock.knobs["radius_m"]
    a, b, c = HALF_AXES_M - r
    slabs = 8 * a * b * c + 8 * r * (a * b + b * c + c * a)
    volume = slabs + 2 * np.pi * r**2 * (a + b + c) + 4 * np.pi * r**3 / 3
    assert rock.truth.volume_m3 == pytest.approx(volume, rel=1e-12)
    assert rock.truth.roundness == pytest.approx(0.5 / 1.5, rel=1e-9)
    np.testing.assert_allclose(np.ptp(rock.mesh.vertices_m, axis=0) / 2, HALF_AXES_M, rtol=1e-12)


def test_open_half_spaces_are_refused():
    normals = np.vstack([np.eye(3), [[0.0, 0.0, -1.0]]])
    with pytest.raises(SpecError, match="bounded"):
        from_half_spaces(normals, np.ones(4))
