"""Scenes: rocks on the ground, apart, in frame, and a full ground said so."""

import numpy as np
import pytest

from synth.camera import project
from synth.errors import InputError
from synth.light import brightness, light_scene
from synth.scene import build_scene
from synth.spec import SceneSpec
from synth.spec.rocks import RocksSpec
from synth.spec.view import CameraSpec, SunSpec


@pytest.mark.parametrize("preset", ["imp", "msl-navcam"])
def test_rocks_rest_apart_and_in_every_frame(preset):
    rocks = RocksSpec(count=4, family="rounded-box")
    scene = build_scene(SceneSpec(seed=2, rocks=rocks, camera=CameraSpec(preset=preset)), 0)
    for placed in scene.rocks:
        # Rounding of a sum of metres.
        assert placed.mesh.vertices_m[:, 2].min() == pytest.approx(0.0, abs=1e-9)
        foot = placed.mesh.vertices_m[placed.mesh.vertices_m[:, 2] < 1e-6]
        low, high = foot[:, :2].min(axis=0), foot[:, :2].max(axis=0)
        # It lies on a facet, and the centroid is above it: it does not roll.
        assert (low < placed.position_m[:2]).all()
        assert (placed.position_m[:2] < high).all()
        for pose in scene.poses:
            pixels = project(scene.camera, pose.camera_points_m(placed.mesh.vertices_m))
            assert pixels.min() >= -0.5
            assert pixels[:, 0].max() <= scene.camera.width - 0.5
            assert pixels[:, 1].max() <= scene.camera.height - 0.5
    for one in range(4):
        for two in range(one):
            gaps = scene.rocks[one].position_m - scene.rocks[two].position_m
            radii = [
                np.linalg.norm((p.mesh.vertices_m - p.position_m)[:, :2], axis=1).max()
                for p in (scene.rocks[one], scene.rocks[two])
            ]
            assert np.linalg.norm(gaps[:2]) >= sum(radii)


def test_model_pose_takes_the_model_to_the_world():
    scene = build_scene(SceneSpec(rocks=RocksSpec(count=1, family="rounded-box")), 0)
    placed = scene.rocks[0]
    moved = placed.rock.mesh.moved(placed.model_to_world, placed.position_m)
    np.testing.assert_allclose(moved.vertices_m, placed.mesh.vertices_m, atol=1e-12)


def test_full_ground_is_one_line():
    spec = SceneSpec(rocks=RocksSpec(count=60, family="rounded-box"))
    with pytest.raises(InputError, match=r"rocks\.count: the ground in view is full") as caught:
        build_scene(spec, 0)
    assert "\n" not in str(caught.value)


def test_level_ground_has_the_same_light_at_any_sun():
    up = np.array([[0.0, 0.0, 1.0]])
    values = [brightness(up, 0.5, SunSpec(elevation_deg=e))[0] for e in (30.0, 48.0, 90.0)]
    # float32 steps by 6e-8.
    np.testing.assert_allclose(values, 0.5 * 1.35, rtol=1e-6)


def test_shadow_of_a_rock_starts_at_its_foot_and_points_from_the_sun():
    sun = SunSpec(azimuth_deg=0.0, elevation_deg=45.0)
    scene = build_scene(SceneSpec(rocks=RocksSpec(count=1, family="rounded-box")), 0)
    stage = light_scene(scene, sun)
    used = stage.shadows.vertices_m[np.unique(stage.shadows.faces)]
    body = scene.rocks[0].mesh.vertices_m
    # At 45 degrees the shadow of height z falls z away, towards −x.
    assert used[:, 0].min() == pytest.approx((body[:, 0] - body[:, 2]).min(), abs=1e-9)
    assert light_scene(scene, SunSpec(shadows=False)).shadows is None
