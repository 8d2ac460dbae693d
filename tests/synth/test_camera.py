"""The camera's conventions."""

import numpy as np
import pytest

from synth.camera.pose import look_at, right_eye
from synth.camera.presets import PRESETS
from synth.camera.projection import project
from synth.camera.trajectories import ring


@pytest.mark.parametrize("name", PRESETS)
def test_the_target_is_at_the_frame_centre_and_the_image_upright(name):
    camera = PRESETS[name].camera
    for pose in ring(count=5, distance_m=4.0, elevation_rad=0.5, start_rad=0.2):
        np.testing.assert_allclose(
            project(camera, pose.camera_points_m(np.zeros(3))), [camera.cx, camera.cy], atol=1e-9
        )
        assert pose.camera_points_m(np.zeros(3))[2] == pytest.approx(4.0)
        assert project(camera, pose.camera_points_m(np.array([0.0, 0.0, 0.1])))[1] < camera.cy
        assert np.linalg.det(pose.world_to_camera) == pytest.approx(1.0)
        assert np.linalg.norm(pose.position_m()) == pytest.approx(4.0)


def test_presets_have_the_pixel_angles_of_the_instruments():
    assert 1000.0 / PRESETS["imp"].camera.fx == pytest.approx(0.98)
    assert 1000.0 / PRESETS["msl-navcam"].camera.fx == pytest.approx(0.82)
    # 45 degrees across in the instrument paper, rounded to a degree.
    camera = PRESETS["msl-navcam"].camera
    assert np.rad2deg(2 * np.arctan(camera.width / 2 / camera.fx)) == pytest.approx(45.0, abs=1.0)


@pytest.mark.parametrize(
    ("name", "across_deg", "down_deg"),
    [("imp", 14.4, 14.0), ("mer-navcam", 45.0, 45.0), ("mer-pancam", 16.0, 16.0)],
)
def test_pinholes_have_the_field_of_their_papers(name, across_deg, down_deg):
    # The papers round to a degree, IMP's to a tenth of 14.4 by 14.0 with square pixels.
    camera = PRESETS[name].camera
    half = np.arctan([camera.width / 2 / camera.fx, camera.height / 2 / camera.fy])
    np.testing.assert_allclose(2 * np.rad2deg(half), [across_deg, down_deg], atol=0.6)


@pytest.mark.parametrize(
    ("name", "lens_deg", "pinhole_deg"),
    [
        ("sojourner", (127.5, 94.5), (96.2, 78.9)),
        ("mer-hazcam", (124.0, 124.0), (94.2, 94.2)),
        ("m2020-navcam", (96.0, 73.0), (80.4, 64.7)),
    ],
)
def test_wide_cameras_are_pinholes_with_their_central_pixel(name, lens_deg, pinhole_deg):
    # With the same angle for every pixel the frame spans the field of the paper, which is rounded
    # to a degree as the pixel's angle is to two digits; the pinhole's is narrower.
    camera = PRESETS[name].camera
    pixels = np.array([camera.width / camera.fx, camera.height / camera.fy])
    np.testing.assert_allclose(np.rad2deg(pixels), lens_deg, atol=1.0)
    np.testing.assert_allclose(2 * np.rad2deg(np.arctan(pixels / 2)), pinhole_deg, atol=0.05)


def test_refining_keeps_the_field():
    camera = PRESETS["imp"].camera
    fine = camera.refined(2)
    ray = np.array([0.05, -0.03, 1.0])
    # A pixel's centre (u, v) lies between the fine centres 2u and 2u + 1.
    np.testing.assert_allclose(project(fine, ray), 2 * project(camera, ray) + 0.5)


def test_straight_down_is_defined():
    pose = look_at(np.array([0.0, 0.0, 3.0]), np.zeros(3))
    np.testing.assert_allclose(pose.camera_points_m(np.array([1.0, 0.0, 0.0])), [1.0, 0.0, 3.0])


@pytest.mark.parametrize(
    ("name", "at_2_m", "at_10_m"),
    [
        ("imp", 0.84, 21.0),
        ("sojourner", 3.0, 74.0),
        ("mer-navcam", 0.52, 13.0),
        ("mer-hazcam", 2.7, 67.0),
        ("mer-pancam", 0.12, 3.0),
        ("msl-navcam", 0.25, 6.2),
        ("m2020-navcam", 0.10, 2.5),
    ],
)
def test_presets_have_the_range_error_of_their_papers(name, at_2_m, at_10_m):
    # Z² σ_d/(f B) in centimetres at σ_d = 0.32 px; the figures are rounded to two digits.
    preset = PRESETS[name]
    error_cm = 100 * 0.32 / (preset.camera.fx * preset.baseline_m)
    assert error_cm * 4 == pytest.approx(at_2_m, rel=0.05)
    assert error_cm * 100 == pytest.approx(at_10_m, rel=0.03)


def test_the_right_eye_sees_points_a_disparity_to_the_left():
    camera = PRESETS["msl-navcam"].camera
    left = look_at(np.array([3.0, 1.0, 2.0]), np.zeros(3))
    point = np.array([0.3, -0.2, 0.1])
    one = project(camera, left.camera_points_m(point))
    two = project(camera, right_eye(left, 0.424).camera_points_m(point))
    depth_m = left.camera_points_m(point)[2]
    # d = f B/Z, along the row alone.
    np.testing.assert_allclose(one - two, [camera.fx * 0.424 / depth_m, 0.0], atol=1e-9)
