"""The moments of rounded bodies: closed forms, Steiner's volume, a mesh that converges to them."""

import numpy as np
import pytest

from synth.geometry.mesh import centroid_m, covariance_m2, volume_m3
from synth.rocks.moments import rounded_moments
from synth.rocks.polyhedron import cuboid, functionals, tangent_cuts
from synth.rocks.rounding import rounded_mesh, rounded_volume_m3

HALF_AXES_M = np.array([0.2, 0.15, 0.1])


def test_moments_of_a_box_and_of_a_ball():
    # A box's second moment is a²/3, a ball's R²/5; what is left of the other is 1e-9 of it.
    box = rounded_moments(cuboid(HALF_AXES_M), 1e-11)
    np.testing.assert_allclose(box.covariance_m2, np.diag(HALF_AXES_M**2 / 3), atol=1e-11)
    ball = rounded_moments(cuboid(np.full(3, 1e-11)), 0.1)
    np.testing.assert_allclose(ball.covariance_m2, np.eye(3) * 0.01 / 5, atol=1e-11)


def test_a_tall_box_with_a_ball_is_a_capsule():
    # Cylinder of half length h and radius r with two half balls, its axis along x: the mean of x²
    # and of y² over π r² (2h + 4r/3). The box's core, 2 µm wide, adds 2e-5 of the volume.
    h, r = 0.2, 0.1
    found = rounded_moments(cuboid(np.array([h, 1e-6, 1e-6])), r)
    volume = np.pi * r**2 * (2 * h + 4 * r / 3)
    along = np.pi * r**2 * (2 * h**3 / 3 + 4 * r / 3 * h**2 + r**2 * h + 4 * r**3 / 15)
    across = np.pi * r**4 * (h / 2 + 4 * r / 15)
    assert found.volume_m3 == pytest.approx(volume, rel=5e-5)
    np.testing.assert_allclose(
        np.diag(found.covariance_m2), np.array([along, across, across]) / volume, rtol=5e-5
    )


@pytest.mark.parametrize("radius_m", [0.005, 0.05])
def test_volume_is_steiners_and_moves_and_turns_with_the_body(radius_m):
    # The same closed form by another route, and equivariance: rounding only.
    body = tangent_cuts(HALF_AXES_M, cuts=13, rng=np.random.default_rng(4))
    moments = rounded_moments(body, radius_m)
    steiner_m3 = rounded_volume_m3(functionals(body), radius_m)
    assert moments.volume_m3 == pytest.approx(steiner_m3, rel=1e-12)
    turn = np.linalg.qr(np.random.default_rng(1).standard_normal((3, 3)))[0]
    turn *= np.linalg.det(turn)
    shift_m = np.array([0.05, -0.04, 0.02])
    moved = rounded_moments(body.mapped(turn).shifted(shift_m), radius_m)
    np.testing.assert_allclose(moved.centroid_m, turn @ moments.centroid_m + shift_m, atol=1e-12)
    np.testing.assert_allclose(
        moved.covariance_m2, turn @ moments.covariance_m2 @ turn.T, atol=1e-13
    )


def test_the_mesh_converges_to_the_moments():
    # The facets' sag falls with the square of their edges: halved edges, a quarter of the error.
    body = tangent_cuts(HALF_AXES_M, cuts=13, rng=np.random.default_rng(5))
    exact = rounded_moments(body, 0.04)
    errors = []
    for split in (1, 2, 4):
        mesh = rounded_mesh(body, 0.04, split=split)
        errors.append(
            [
                abs(volume_m3(mesh) / exact.volume_m3 - 1.0),
                np.abs(covariance_m2(mesh) - exact.covariance_m2).max(),
                np.abs(centroid_m(mesh) - exact.centroid_m).max(),
            ]
        )
    ratios = np.array(errors[:-1]) / np.array(errors[1:])
    # Pieces are whole numbers of steps, so not every step is halved exactly.
    assert (ratios[:, :2] > 3.0).all()
    assert (ratios[:, :2] < 5.0).all()
    assert errors[0][2] < 1e-6
    assert errors[2][0] < 3e-5
