"""The lens: its inverse, what it refuses, and one place for an edge in image, depth and labels."""

from dataclasses import replace

import numpy as np
import pytest

from synth.camera.camera import RenderCamera
from synth.camera.lens import check_lens, distorted, undistorted
from synth.camera.pose import look_at
from synth.camera.projection import border_rays, project
from synth.camera.trajectories import camera_of
from synth.errors import SpecError
from synth.geometry.mesh import Mesh
from synth.light import light_scene
from synth.render import open_renderer, render_view
from synth.render.view import depth_limits_m
from synth.rocks.ellipsoid import ellipsoid
from synth.scene.ground import make_ground
from synth.scene.laying import PlacedRock
from synth.scene.scene import SceneModel, build_scene
from synth.spec import convert_spec
from synth.spec.ground import GroundSpec
from synth.spec.surface import SurfaceSpec
from synth.spec.view import CameraSpec, SunSpec

BARREL = (-0.25, 0.06, 1e-3, -2e-3, 0.0)
PINCUSHION = (0.4, 0.0, 0.0, 1e-3, 0.0)
CAMERA = RenderCamera(260.0, 250.0, 159.5, 119.5, 320, 240)
# A board at x = 0.3 that faces the camera, leaning: y, z of its corners.
BOARD = np.array([[-0.9, 0.3], [0.8, 0.2], [0.9, 1.3], [-0.7, 1.4]])


@pytest.mark.parametrize("lens", [BARREL, PINCUSHION, (1.0, 0.0, 0.0, 0.0, 0.0)])
def test_the_inverse_undoes_the_lens(lens):
    camera = replace(CAMERA, distortion=lens)
    x, y = np.meshgrid(np.linspace(-0.6, 0.6, 9), np.linspace(-0.5, 0.5, 9))
    back = undistorted(camera, *distorted(camera, x, y))
    # Newton's steps end below 1e-13.
    np.testing.assert_allclose(back, (x, y), atol=1e-12)


def test_a_lens_that_folds_the_image_is_refused():
    # x (1 − r²) turns back at r = 0.58; the navcam's corner is at 0.59.
    with pytest.raises(SpecError, match=r"camera\.distortion: .*-1\.0, 0\.0.*folds"):
        camera_of(CameraSpec(distortion=(-1.0, 0.0, 0.0, 0.0, 0.0)))
    check_lens(replace(CAMERA, distortion=BARREL))


@pytest.mark.parametrize("lens", [BARREL, PINCUSHION])
def test_the_border_is_projected_onto_the_frame(lens):
    camera = replace(CAMERA, distortion=lens)
    left, top, right, bottom = (
        project(camera, np.column_stack([side, np.ones(len(side))])) for side in border_rays(camera)
    )
    for found, expected in ((left[:, 0], -0.5), (right[:, 0], 319.5)):
        np.testing.assert_allclose(found, expected, atol=1e-9)
    for found, expected in ((top[:, 1], -0.5), (bottom[:, 1], 239.5)):
        np.testing.assert_allclose(found, expected, atol=1e-9)


@pytest.mark.parametrize("lens", [list(BARREL), list(PINCUSHION)])
def test_every_rock_is_whole_in_every_view_through_a_lens(lens):
    table = {
        "seed": 4,
        "rocks": {"count": 3},
        "camera": {"preset": "mer-hazcam", "distance_m": 1.6, "distortion": lens},
    }
    scene = build_scene(convert_spec(table, where="test"), 0)
    assert len(scene.rocks) == 3
    for placed in scene.rocks:
        for pose in scene.poses:
            pixels = project(scene.camera, pose.camera_points_m(placed.mesh.vertices_m))
            assert pixels.min() >= -0.5
            assert pixels.max() <= 1023.5


@pytest.fixture(scope="module", params=[BARREL, PINCUSHION, None])
def seen(request):
    """Return a camera, a pose and its view of the board before the ground."""
    camera = replace(CAMERA, distortion=request.param)
    corners = np.column_stack([np.full(4, 0.3), BOARD])
    board = Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), np.tile([1.0, 0.0, 0.0], (4, 1)))
    placed = PlacedRock(
        rock=ellipsoid(np.ones(3)),
        model_to_world=np.eye(3),
        position_m=np.zeros(3),
        albedo=0.1,
        mesh=board,
    )
    pose = look_at(np.array([2.6, 0.2, 1.6]), np.array([0.0, 0.0, 0.5]))
    ground = make_ground(GroundSpec(), radius_m=4.0, rng=np.random.default_rng(1))
    scene = SceneModel(rocks=(placed,), camera=camera, poses=(pose,), ground=ground)
    sun = SunSpec(shadows=False)
    stage = light_scene(scene, sun, SurfaceSpec(contrast=0.0))
    renderer = open_renderer("embree", stage, camera)
    return camera, pose, render_view(renderer, stage, camera, pose, supersample=4)


@pytest.mark.parametrize(("start", "stop"), [(0, 3), (1, 2)])
def test_an_edge_is_at_one_place_in_image_depth_and_labels(seen, start, stop):
    camera, pose, view = seen
    shares = np.linspace(0.0, 1.0, 4001)[:, None]
    yz = BOARD[start] + shares * (BOARD[stop] - BOARD[start])
    points = pose.camera_points_m(np.column_stack([np.full(len(yz), 0.3), yz]))
    column, row = project(camera, points).T
    for line in range(int(row.min()) + 4, int(row.max()) - 4):
        expected = column[np.argmin(np.abs(row - line))]  # 4001 points: within 0.05 px
        near = np.arange(int(expected) - 4, int(expected) + 6)
        inside = view.labels[line, near] == 1
        # A pixel's label is its centre's: the edge is within half a pixel of the change.
        change = np.flatnonzero(inside[1:] != inside[:-1])
        assert len(change) == 1
        assert abs(near[change[0]] + 0.5 - expected) < 0.55
        jump = np.abs(np.diff(view.depth_m[line, near]))
        assert np.argmax(jump) == change[0]
        # The image counts the covered share of each pixel, in sixteenths here.
        light = view.light[line, near].astype(float)
        covered = np.sum((light - light[-1]) / (light[0] - light[-1]))
        assert abs(near[0] - 0.5 + covered - expected) < 0.3


def test_depth_along_the_undistorted_ray_is_the_surface(seen):
    camera, pose, view = seen
    row, column = np.nonzero(view.labels == 1)
    depth_m = view.depth_m[row, column]
    across, down = undistorted(
        camera, (column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy
    )
    points_m = np.column_stack([across, down, np.ones(len(row))]) * depth_m[:, None]
    world_m = (points_m - pose.translation_m) @ pose.world_to_camera
    # Embree counts in float32: 1e-7 of 3 m.
    np.testing.assert_allclose(world_m[:, 0], 0.3, atol=5e-6)


@pytest.mark.parametrize("lens", [BARREL, PINCUSHION])
def test_ground_fills_the_frame(lens):
    # The middle of a cushion's upper side sees farther than its corners, by 9 % of depth here;
    # the near limit of a barrel's lower side likewise.
    camera = replace(CAMERA, distortion=lens)
    pose = look_at(np.array([3.0, 0.0, 3.0]), np.zeros(3))
    ground = make_ground(GroundSpec(), radius_m=4.0, rng=np.random.default_rng(1))
    scene = SceneModel(rocks=(), camera=camera, poses=(pose,), ground=ground)
    stage = light_scene(scene, SunSpec(), SurfaceSpec())
    near_m, far_m = depth_limits_m(stage, camera, pose)
    _, depth_m = open_renderer("embree", stage, camera).measure(pose, (near_m, far_m), None)
    assert not np.isnan(depth_m).any()
    assert near_m < depth_m.min()
