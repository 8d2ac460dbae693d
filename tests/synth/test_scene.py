"""Scenes: rocks on the ground, apart, in frame, and a full ground said so."""

import numpy as np
import pytest

from synth.camera.projection import project
from synth.errors import SpecError
from synth.rocks import quarry
from synth.scene import scene as scene_module
from synth.scene.scene import build_scene
from synth.spec import SceneSpec
from synth.spec.rocks import RocksSpec
from synth.spec.view import CameraSpec


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
    with pytest.raises(SpecError, match=r"rocks\.count: the ground in view is full") as caught:
        build_scene(spec, 0)
    assert "\n" not in str(caught.value)


def test_a_crowd_is_refused_before_its_rocks_are_made(monkeypatch):
    asked = []

    def counted(spec, *, rng):
        asked.append(spec.count)
        return quarry(spec, rng=rng)

    monkeypatch.setattr(scene_module, "quarry", counted)
    spec = SceneSpec(rocks=RocksSpec(count=400, family="rounded-box"))
    with pytest.raises(SpecError, match=r"expected at most \d+ rocks .* found 400"):
        build_scene(spec, 0)
    assert max(asked) < 20


def test_a_crowd_that_fits_is_laid():
    rocks = RocksSpec(count=40, family="rounded-box", diameter_m=(0.08, 0.1), spacing=1.0)
    assert len(build_scene(SceneSpec(rocks=rocks), 0).rocks) == 40
