"""Silhouettes beyond the frame, against a camera with a frame nine times as large."""

from dataclasses import replace

import numpy as np
import pytest

from synth.camera.pose import look_at
from synth.camera.presets import PRESETS
from synth.dataset.bop import scene_gt_info
from synth.dataset.bop_canvas import Beyond, Canvas
from synth.light import light_scene
from synth.render import choose_backend, open_renderer, render_view
from synth.render.view import depth_limits_m
from synth.scene.scene import SceneModel, build_scene
from synth.spec import SceneSpec
from synth.spec.rocks import RocksSpec
from synth.spec.view import CameraSpec, ViewsSpec

SPEC = SceneSpec(
    rocks=RocksSpec(count=3, family="rounded-box"),
    camera=CameraSpec(preset="imp"),
    views=ViewsSpec(count=1),
)


def scene_from(target_m, *, wide=False, distortion=None):
    """Return a scene whose camera looks past its rocks, and, if wide, sees the whole canvas."""
    scene = build_scene(SPEC, 0)
    camera = replace(scene.camera, distortion=distortion)
    if wide:
        camera = replace(
            camera,
            width=3 * camera.width,
            height=3 * camera.height,
            cx=camera.cx + camera.width,
            cy=camera.cy + camera.height,
        )
    poses = (look_at(scene.poses[0].position_m(), np.array(target_m)),)
    return SceneModel(rocks=scene.rocks, camera=camera, poses=poses, ground=scene.ground)


def view_of(scene):
    stage = light_scene(scene, SPEC.sun)
    renderer = open_renderer(choose_backend("embree"), stage, scene.camera)
    return render_view(renderer, stage, scene.camera, scene.poses[0], supersample=1)


def wholes_of(scene):
    """Return each rock's mask as if it were alone."""
    stage = light_scene(scene, SPEC.sun)
    renderer = open_renderer(choose_backend("embree"), stage, scene.camera)
    limits_m = depth_limits_m(stage, scene.camera, scene.poses[0])
    return [
        renderer.measure(scene.poses[0], limits_m, [instance])[0] > 0
        for instance in range(len(scene.rocks))
    ]


@pytest.mark.parametrize(
    ("target_m", "distortion"),
    [
        ((0.0, 0.8, 0.1), None),
        ((2.5, 2.5, 0.0), None),
        ((0.9, -0.9, 0.4), (-0.2, 0.05, 0.001, -0.001, 0.0)),
    ],
)
def test_counts_and_boxes_are_the_large_canvass(target_m, distortion):
    scene = scene_from(target_m, distortion=distortion)
    view = view_of(scene)
    infos = scene_gt_info(scene, [view], [view.depth_m > 0.0])["0"]
    wide = wholes_of(scene_from(target_m, wide=True, distortion=distortion))
    width, height = scene.camera.width, scene.camera.height
    for info, whole, seen in zip(infos, wide, view.silhouettes, strict=True):
        # Both take a pixel where its centre's ray meets the mesh; single precision decides a few.
        assert info["px_count_all"] == pytest.approx(whole.sum(), abs=2)
        assert info["px_count_all"] >= seen.sum()
        if not info["px_count_visib"]:
            assert info["bbox_obj"] == [-1, -1, -1, -1]
            continue
        rows, cols = np.nonzero(whole)
        box = [cols.min() - width, rows.min() - height, np.ptp(cols), np.ptp(rows)]
        assert np.abs(np.array(info["bbox_obj"]) - box).max() <= 1
        assert info["visib_fract"] == pytest.approx(info["px_count_visib"] / info["px_count_all"])
    assert any(
        info["px_count_all"] > mask.sum()
        for info, mask in zip(infos, view.silhouettes, strict=True)
    )


def test_a_rock_round_the_camera_is_counted_ahead_alone():
    # A camera inside a rock sees it everywhere on the canvas: nine frames, eight beyond.
    scene = build_scene(SPEC, 0)
    camera = PRESETS["imp"].camera
    middle_m = scene.rocks[0].position_m
    pose = look_at(middle_m, middle_m + np.array([1.0, 0.2, 0.1]))
    inside = SceneModel(rocks=scene.rocks[:1], camera=camera, poses=(pose,), ground=scene.ground)
    view = view_of(inside)
    assert np.isnan(view.boxes_px[0]).all()
    info = scene_gt_info(inside, [view], [view.depth_m > 0.0])["0"][0]
    beyond = info["px_count_all"] - int(view.silhouettes[0].sum())
    assert beyond == 8 * camera.width * camera.height


def test_a_rock_behind_the_camera_sends_no_rays(monkeypatch):
    scene = build_scene(SPEC, 0)
    stand_m = scene.rocks[0].position_m + np.array([5.0, 0.0, 0.3])
    pose = look_at(stand_m, stand_m + np.array([1.0, 0.1, 0.0]))
    monkeypatch.setattr("synth.dataset.bop_canvas._rays", pytest.fail)
    nowhere = np.full(4, np.nan)
    assert Canvas(scene).beyond(0, pose, nowhere) == Beyond(count_px=0, window=None)
