"""The camera's conventions."""

import numpy as np
import pytest

from synth.camera import PRESETS, look_at, project, ring


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


def test_refining_keeps_the_field():
    camera = PRESETS["imp"].camera
    fine = camera.refined(2)
    ray = np.array([0.05, -0.03, 1.0])
    # A pixel's centre (u, v) lies between the fine centres 2u and 2u + 1.
    np.testing.assert_allclose(project(fine, ray), 2 * project(camera, ray) + 0.5)


def test_straight_down_is_defined():
    pose = look_at(np.array([0.0, 0.0, 3.0]), np.zeros(3))
    np.testing.assert_allclose(pose.camera_points_m(np.array([1.0, 0.0, 0.0])), [1.0, 0.0, 3.0])
