"""Smallest boxes, inertia and sphericity against closed forms."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from synth.geometry.mesh import area_m2, covariance_m2, volume_m3
from synth.geometry.min_volume_box import nearby_box, smallest_box
from synth.rocks.ellipsoid import ellipsoid, ellipsoid_area_m2
from synth.rocks.polyhedron import cuboid
from synth.rocks.relief import with_relief
from synth.rocks.rounding import rounded_mesh
from synth.rocks.truth import half_axes_of_covariance_m, maximum_projection_sphericity

HALF_AXES_M = np.array([0.2, 0.15, 0.1])


@pytest.mark.parametrize("seed", range(5))
def test_smallest_box_of_a_turned_box_is_the_box(seed):
    # The search ends with turns of 1e-8 rad, which change a side by no more than 1e-8 of another.
    turn = Rotation.random(random_state=seed).as_matrix()
    points_m = cuboid(HALF_AXES_M).vertices_m @ turn.T + 0.3
    box = smallest_box(points_m)
    np.testing.assert_allclose(box.half_sides_m, HALF_AXES_M, rtol=1e-6)
    np.testing.assert_allclose(box.centre_m, 0.3, rtol=1e-6)
    assert np.linalg.det(box.axes) == pytest.approx(1.0, abs=1e-9)


def test_margin_adds_to_each_half_side():
    box = smallest_box(cuboid(HALF_AXES_M).vertices_m, margin_m=0.05)
    np.testing.assert_allclose(box.half_sides_m, HALF_AXES_M + 0.05, rtol=1e-6)


@pytest.mark.parametrize("seed", [3, 19, 27])
def test_no_search_from_random_turns_finds_a_smaller_box_of_a_rough_rock(seed):
    # The facets that are tried miss the box of seeds 19 and 27 by 2e-3 and 6e-4 of its volume. Of
    # 50 such rocks the search ended at most 1.2e-5 above the best of 100 random starts.
    rng = np.random.default_rng(seed)
    smooth = ellipsoid(np.array([0.2, 0.16, 0.12]))
    rock = with_relief(smooth, relief_rms=0.03, degrees=(3, 14), rng=rng)
    points_m = rock.mesh.vertices_m[ConvexHull(rock.mesh.vertices_m).vertices]
    turns = Rotation.random(40, random_state=0).as_matrix()
    others = [np.prod(nearby_box(points_m @ turn.T).half_sides_m) for turn in turns]
    assert np.prod(rock.truth.half_axes_box_m) < min(others) * (1.0 + 1e-4)


def test_ellipsoid_truth_is_measured_on_its_mesh():
    # 20,480 faces: the inscribed mesh has 5.4e-4 less volume; along a turned axis the outermost
    # vertex falls short of the surface by at most 0.1 %.
    rock = ellipsoid(HALF_AXES_M)
    turned = rock.mesh.moved(Rotation.random(random_state=1).as_matrix(), np.zeros(3))
    assert volume_m3(rock.mesh) == pytest.approx(4 * np.pi * 0.003 / 3, rel=1e-3)
    assert area_m2(rock.mesh) == pytest.approx(rock.truth.area_m2, rel=1e-3)
    np.testing.assert_allclose(
        half_axes_of_covariance_m(covariance_m2(turned)), HALF_AXES_M, rtol=1e-3
    )
    np.testing.assert_allclose(smallest_box(turned.vertices_m).half_sides_m, HALF_AXES_M, rtol=2e-3)


def test_sphere_has_sphericity_one_and_area_of_a_sphere():
    rock = ellipsoid(np.full(3, 0.1))
    assert rock.truth.wadell_sphericity() == pytest.approx(1.0, rel=1e-12)
    assert rock.truth.maximum_projection_sphericity() == pytest.approx(1.0, rel=1e-12)
    assert ellipsoid_area_m2(np.full(3, 2.0)) == pytest.approx(16 * np.pi, rel=1e-12)


def test_maximum_projection_sphericity_of_a_cube_and_a_slab():
    assert maximum_projection_sphericity(np.ones(3)) == 1.0
    assert maximum_projection_sphericity(np.array([2.0, 1.0, 0.5])) == pytest.approx(0.5)


def test_box_inertia():
    # A box's second moment is a²/3 of its half side, a solid ellipsoid's a²/5; r → 0 mesh.
    mesh = rounded_mesh(cuboid(HALF_AXES_M), 1e-7)
    expected = HALF_AXES_M * np.sqrt(5 / 3)
    # The rounding of 0.1 µm is 1e-6 of the shortest half side.
    np.testing.assert_allclose(half_axes_of_covariance_m(covariance_m2(mesh)), expected, rtol=1e-5)
