"""Lens distortion: each model against OpenCV's or its formula, and its inverse."""

import cv2
import numpy as np
import pytest

from rockshape.camera.distortion import BrownConrady, Distortion, Fisheye, InverseBrownConrady

PLANE = np.random.default_rng(3).uniform(-0.5, 0.5, (500, 2))
BROWN = (-0.28, 0.07, 0.001, -0.0007, -0.01)
FISHEYE = (0.03, -0.01, 0.004, -0.001)
RATIONAL = (0.2, -0.1, 1e-4, 2e-4, 0.03, 0.25, -0.05, 0.02)


@pytest.mark.parametrize(
    "model",
    [BrownConrady(BROWN), BrownConrady(RATIONAL), InverseBrownConrady(BROWN), Fisheye(FISHEYE)],
    ids=["Brown", "rational", "inverse Brown", "fisheye"],
)
def test_undistortion_inverts_distortion(model: Distortion) -> None:
    seen = model.distort(PLANE)
    assert np.abs(seen - PLANE).max() > 0.01
    np.testing.assert_allclose(model.undistort(seen), PLANE, atol=1e-7)


def test_brown_conrady_is_its_formula() -> None:
    k1, k2, p1, p2, k3 = BROWN
    x, y = PLANE.T
    r2 = x**2 + y**2
    radial = 1 + k1 * r2 + k2 * r2**2 + k3 * r2**3
    expected = [
        x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x**2),
        y * radial + p1 * (r2 + 2 * y**2) + 2 * p2 * x * y,
    ]
    np.testing.assert_allclose(BrownConrady(BROWN).distort(PLANE).T, expected, atol=1e-12)
    np.testing.assert_allclose(InverseBrownConrady(BROWN).undistort(PLANE).T, expected, atol=1e-12)


def test_a_fisheye_is_opencvs() -> None:
    theirs = cv2.fisheye.distortPoints(PLANE[None], np.eye(3), np.array(FISHEYE))[0]
    np.testing.assert_allclose(Fisheye(FISHEYE).distort(PLANE), theirs, atol=1e-9)
    assert Fisheye(FISHEYE).distort(np.zeros((1, 2))).tolist() == [[0, 0]]


def test_what_a_lens_cannot_show_is_nan() -> None:
    folded = BrownConrady((-0.3, 0.0, 0.0, 0.0))  # r (1 - 0.3 r²) is at most 0.7027
    beyond = folded.undistort(np.array([[0.75, 0.0], [0.6, 0.0]]))
    assert np.isnan(beyond[0]).all()
    assert np.isfinite(beyond[1]).all()
    assert np.isnan(Fisheye((0.0, 0.0, 0.0, 0.0)).undistort(np.array([[1.6, 0.0]]))).all()
