"""Straightening a lens: analytic pictures and planes there and back, and what the frame holds."""

from dataclasses import replace

import numpy as np
import pytest

from synth.camera.camera import RenderCamera
from synth.camera.lens import undistorted
from synth.camera.projection import pixel_rays
from synth.light import light_scene
from synth.render import open_renderer, render_view
from synth.scene.scene import build_scene
from synth.sensor import capture_view
from synth.sensor.rectify import Rectification
from synth.sensor.rig import rig_of
from synth.spec import convert_spec

CAMERA = RenderCamera(260.0, 250.0, 159.5, 119.5, 320, 240)


@pytest.fixture(params=[(-0.25, 0.06, 1e-3, -2e-3, 0.0), (0.4, 0.0, 0.0, 1e-3, 0.0)])
def lens(request):
    """Return the rectification of a camera with a barrel's or a cushion's lens."""
    return Rectification(replace(CAMERA, distortion=request.param))


def rays(camera):
    return np.broadcast_arrays(*undistorted(camera, *pixel_rays(camera)))


def waves(camera):
    """Return a picture, (rows, cols), of waves of 20 px and more."""
    across, down = rays(camera)
    return np.rint(128.0 + 60.0 * np.sin(70.0 * across) + 50.0 * np.cos(60.0 * down + 9.0 * across))


def plane_px(camera):
    """Return the disparities of a slanted plane."""
    across, down = rays(camera)
    return 30.0 + 18.0 * down + 6.0 * across


def test_a_straightened_picture_is_the_pinholes(lens):
    found = lens.straight_picture(waves(lens.camera).astype(np.uint8)).astype(float)
    inner = lens.seen & (np.abs(lens._column - 159.5) < 157) & (np.abs(lens._row - 119.5) < 117)
    # Three roundings make 0.5 grey levels, OpenCV's cubic on waves of 23 px as much again.
    assert np.std((found - waves(lens.pinhole))[inner]) < 1.0


def test_disparities_go_there_and_back(lens):
    straight_px = lens.straight_disparity_px(plane_px(lens.camera))
    inner = lens.seen & (np.abs(lens._column - 159.5) < 159) & (np.abs(lens._row - 119.5) < 119)
    # cv2.remap has 32 places in a pixel; a disparity changes by 0.08 px from one to the next.
    np.testing.assert_allclose(straight_px[inner], plane_px(lens.pinhole)[inner], atol=5e-3)
    back_px = lens.bent_disparity_px(plane_px(lens.pinhole))
    np.testing.assert_allclose(back_px, plane_px(lens.camera), atol=5e-3)


def test_the_pinhole_holds_all_that_the_lens_sees(lens):
    everywhere = np.ones((lens.pinhole.height, lens.pinhole.width), dtype=bool)
    assert lens.bent_mask(everywhere).all()
    column, row = lens._back
    assert column.min() >= -0.5
    assert column.max() <= lens.pinhole.width - 0.5
    assert row.min() >= -0.5
    assert row.max() <= lens.pinhole.height - 0.5


def test_no_disparity_is_mixed_across_an_edge(lens):
    near = rays(lens.camera)[0] > 0.1
    straight_px = lens.straight_disparity_px(np.where(near, 50.0, 20.0))
    assert set(np.unique(straight_px[lens.seen])) == {20.0, 50.0}


@pytest.mark.parametrize("kind", ["stereo", "sgm"])
def test_stereo_measures_through_a_lens(kind):
    # k1 of ±1 moves the corners of imp's narrow frame by 5.5 px.
    table = {"seed": 3, "camera": {"preset": "imp", "distortion": [-1.0, 0, 0, 0, 0]},
             "views": {"count": 1}, "noise": {"kind": kind, "disparity_px": 0.1}}  # fmt: skip
    spec = convert_spec(table, where="test")
    scene = build_scene(spec, 0)
    stage = light_scene(scene, spec.sun, spec.surface)
    renderer = open_renderer("embree", stage, scene.camera)
    view = render_view(renderer, stage, scene.camera, scene.poses[0], supersample=2)

    capture = capture_view(
        view,
        scene.poses[0],
        spec=spec,
        scene=0,
        number=0,
        camera=scene.camera,
        stage=stage,
        renderer=renderer,
    )
    found_m = capture.depth_m
    rig = rig_of("imp")
    error_px = rig.disparity_px(found_m) - rig.disparity_px(view.depth_m)
    # The matcher's error on clean pictures is 0.13 px, the model's here 0.1; the left 5 % of the
    # frame are outside the right eye's.
    assert np.sqrt(np.nanmean(error_px**2)) < 0.2
    assert abs(np.nanmedian(error_px)) < 0.03
    assert 0.03 < np.isnan(found_m).mean() < 0.09
