"""scene_gt_shape.json: every field's value against what it says."""

import numpy as np
import pytest

from synth.dataset.shape_truth import RESOLVABLE_PX, scene_gt_shape
from synth.light import light_scene
from synth.render import choose_backend, open_renderer, render_view
from synth.scene.scene import build_scene
from synth.spec import SceneSpec, convert_spec
from synth.spec.rocks import RocksSpec
from synth.spec.view import ViewsSpec


def test_outline_truth_is_what_the_camera_sees():
    spec = SceneSpec(rocks=RocksSpec(count=2), views=ViewsSpec(count=1))
    scene = build_scene(spec, 0)
    stage = light_scene(scene, spec.sun)
    renderer = open_renderer(choose_backend("embree"), stage, scene.camera)
    view = render_view(renderer, stage, scene.camera, scene.poses[0], supersample=1)
    table = scene_gt_shape(scene, 1, [view])
    for instance, (rock, sight) in enumerate(zip(table["rocks"], table["views"]["0"], strict=True)):
        # The frame's plane cuts the bundle of rays askew: 1/cos of the angle off the axis. What
        # is left is perspective, 2 % at this distance, and half a pixel round 80 px, 2 %.
        camera_points_m = scene.poses[0].camera_points_m(scene.rocks[instance].position_m)
        cosine = camera_points_m[2] / np.linalg.norm(camera_points_m)
        area_m2 = view.silhouettes[instance].sum() * sight["pixel_m"] ** 2 * cosine
        assert sight["outline_area_m2"] == pytest.approx(area_m2, rel=0.04)
        assert sight["outline_exact"]
        assert sight["resolvable"] == (rock["radius_m"] / sight["pixel_m"] >= RESOLVABLE_PX)
        assert 0.0 < sight["outline_axis_ratio"] <= 1.0
        # The inscribed disc of an outline is no smaller than the ball inside the rock.
        assert sight["outline_roundness"] <= rock["roundness"] * (1.0 + 1e-9)
        a, b, c = rock["half_axes_box_m"]
        assert rock["krumbein_sphericity"] == pytest.approx(np.cbrt(b * c / a**2), rel=1e-12)
        assert rock["relief_rms_m"] == 0.0
        assert rock["source"] is None


@pytest.mark.parametrize("family", ["dented", "slab"])
def test_labels_of_rocks_that_are_not_convex_have_their_outlines_area(family):
    spec = convert_spec(
        {
            "seed": 3,
            "rocks": {"count": 2, "family": family, "options": {"subdivisions": 5}},
            "camera": {"preset": "imp"},
            "views": {"count": 1},
        },
        where="test",
    )
    scene = build_scene(spec, 0)
    stage = light_scene(scene, spec.sun)
    renderer = open_renderer(choose_backend("embree"), stage, scene.camera)
    view = render_view(renderer, stage, scene.camera, scene.poses[0], supersample=1)
    sights = scene_gt_shape(scene, 1, [view])["views"]["0"]
    for placed, sight in zip(scene.rocks, sights, strict=True):
        # Level ground touches a rock that lies stably, and no rock is below it.
        turned_m = placed.rock.mesh.vertices_m @ placed.model_to_world.T + placed.position_m
        assert turned_m[:, 2].min() == pytest.approx(0.0, abs=1e-6)
        camera_points_m = scene.poses[0].camera_points_m(placed.position_m)
        cosine = camera_points_m[2] / np.linalg.norm(camera_points_m)
        area_m2 = (view.labels == sight["instance"] + 1).sum() * sight["pixel_m"] ** 2 * cosine
        # Perspective is 1 % at this distance, half a pixel round 30 px is 3 %.
        assert sight["outline_area_m2"] == pytest.approx(area_m2, rel=0.05)
        assert not sight["outline_exact"]
        assert sight["form_outline_roundness"] == sight["outline_roundness"]  # no relief on it
