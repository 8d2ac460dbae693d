"""A bed before the renderers: labels and depth of both agree."""

import numpy as np
import pytest

import synth
from synth.bed.stage import bed_stage, bed_surface, render_bed
from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.camera.trajectories import ring
from synth.errors import SpecError


@pytest.fixture(scope="module")
def bed():
    """Cobbles on sand."""
    return synth.make_bed(
        seed=2, width_px=120, height_px=90, bodies=20,
        grains={"median_px": [20, 20], "cover": [0.8, 0.8], "shapes": ["cobble"]},
    )  # fmt: skip


def test_the_surface_is_the_height_field(bed):
    vertices_m, faces, labels = bed_surface(bed, pixel_m=0.02)
    assert vertices_m[:, 2].reshape(90, 120) == pytest.approx(0.02 * bed.height_px)
    assert np.ptp(vertices_m[:, 0]) == pytest.approx(0.02 * 119)
    assert vertices_m[0, 1] == pytest.approx(0.02 * 44.5)
    assert len(faces) == len(labels) == 2 * 119 * 89
    one, two, three = vertices_m[faces].transpose(1, 0, 2)
    assert (np.cross(two - one, three - one)[:, 2] > 0.0).all()  # outward is up
    doubled = np.cross(two - one, three - one)[:, 2].sum()
    assert doubled / 2.0 == pytest.approx(0.02**2 * 119 * 89)


def test_from_high_above_the_renderer_sees_the_beds_own_labels_and_heights(bed):
    above_m, pixel_m = 100.0, 0.01
    camera = RenderCamera(
        fx=above_m / pixel_m, fy=above_m / pixel_m, cx=59.5, cy=44.5, width=120, height=90
    )
    down = np.diag([1.0, -1.0, -1.0])
    pose = Pose(world_to_camera=down, translation_m=-down @ np.array([0.0, 0.0, above_m]))
    view = render_bed(bed, camera, pose, pixel_m=pixel_m)
    inner = (slice(3, -3), slice(3, -3))
    assert (view.labels == bed.labels)[inner].mean() > 0.9
    heights_px = (above_m - view.depth_m) / pixel_m
    apart = (heights_px - bed.height_px)[inner]
    assert np.abs(apart - np.median(apart)).mean() < 0.35


def test_from_the_side_grains_keep_their_labels_and_their_light(bed):
    camera = RenderCamera(fx=200.0, fy=200.0, cx=79.5, cy=59.5, width=160, height=120)
    (pose,) = ring(count=1, distance_m=1.6, elevation_rad=np.deg2rad(35.0), start_rad=0.3)
    view = render_bed(bed, camera, pose)
    seen = set(np.unique(view.labels))
    assert seen <= {0, *bed.rocks["id"]}
    big = bed.rocks[bed.rocks["visible_px"] > 40]["id"]
    assert len(seen & set(big)) > 0.6 * len(big)
    assert view.image.std() > 5.0
    assert bed_stage(bed).painter is not None


def test_a_pixel_of_no_size_is_refused(bed):
    with pytest.raises(SpecError, match="pixel_m: expected above 0"):
        bed_stage(bed, pixel_m=0.0)
