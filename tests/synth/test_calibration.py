"""Reported cameras: errors of calibration, the truth beside them, and range files with holes."""

import json

import cv2
import numpy as np
import pytest

import synth
from rockshape.io import read_camera, read_range
from synth.camera.calibration import reported_camera, reported_pose
from synth.camera.pose import Pose, look_at
from synth.camera.presets import PRESETS
from synth.dataset.generate import generate_dataset
from synth.errors import SpecError
from synth.spec import convert_spec

SCENE = {
    "seed": 3,
    "rocks": {"count": 2},
    "camera": {"preset": "imp"},
    "views": {"count": 2},
    "noise": {"kind": "lidar", "options": {"line_deg": 2.0}},
}
ERRORS = {"focal": 0.01, "principal_px": 2.0, "turn_deg": 0.5, "shift_m": 0.01}


def spec_of(**tables):
    return convert_spec({**SCENE, **tables}, where="test")


def angle_deg(one: Pose, two: Pose) -> float:
    turn = one.world_to_camera @ two.world_to_camera.T
    return float(np.rad2deg(np.arccos(np.clip((np.trace(turn) - 1.0) / 2.0, -1.0, 1.0))))


def test_errors_have_the_deviations_that_were_asked_for():
    camera, pose = PRESETS["imp"].camera, look_at(np.array([3.0, 1.0, 2.0]), np.zeros(3))
    cameras = [reported_camera(spec_of(seed=n, calibration=ERRORS), camera) for n in range(400)]
    focal = np.array([one.fx for one in cameras]) / camera.fx - 1.0
    # 400 values: σ is known to 3.5 %; four of them.
    assert focal.std() == pytest.approx(0.01, rel=0.14)
    assert np.std([one.cx - camera.cx for one in cameras]) == pytest.approx(2.0, rel=0.14)
    assert all(one.fy / one.fx == pytest.approx(camera.fy / camera.fx) for one in cameras)
    spec = spec_of(calibration=ERRORS)
    poses = [reported_pose(spec, pose, scene=0, view=n) for n in range(400)]
    # About three axes: the angle's mean square is 3 σ².
    square = np.mean([angle_deg(pose, one) ** 2 for one in poses])
    assert np.sqrt(square / 3.0) == pytest.approx(0.5, rel=0.1)
    moved = np.array([one.position_m() - pose.position_m() for one in poses])
    np.testing.assert_allclose(moved.std(axis=0), 0.01, rtol=0.14)


@pytest.fixture(scope="module")
def dataset(tmp_path_factory):
    """A scene with errors of calibration and range files."""
    out = tmp_path_factory.mktemp("made") / "out"
    spec = spec_of(calibration=ERRORS, dataset={"hole_value": "-9999"})
    generate_dataset(spec, out)
    plain = tmp_path_factory.mktemp("plain") / "out"
    generate_dataset(spec_of(), plain)
    return spec, out, plain


def table(path):
    return json.loads(path.read_text())


def test_the_dataset_reports_wrong_cameras_and_keeps_the_true_ones(dataset):
    spec, out, plain = dataset
    assert table(out / "camera_gt.json") == table(plain / "camera.json")
    assert table(out / "000000/scene_gt_camera.json") == table(plain / "000000/scene_camera.json")
    reported, true = table(out / "camera.json"), table(plain / "camera.json")
    camera = reported_camera(spec, PRESETS["imp"].camera)
    assert reported["fx"] == pytest.approx(camera.fx)
    assert reported["fx"] != pytest.approx(true["fx"], rel=1e-5)
    views = table(out / "000000/scene_camera.json")
    np.testing.assert_allclose(views["1"]["cam_K"], camera.matrix().ravel())
    true_views = table(plain / "000000/scene_camera.json")
    assert views["0"]["cam_t_w2c"] != pytest.approx(true_views["0"]["cam_t_w2c"], abs=1.0)


def test_all_else_is_as_without_errors(dataset):
    _, out, plain = dataset
    names = {path.relative_to(out) for path in out.rglob("*") if path.is_file()}
    others = {path.relative_to(plain) for path in plain.rglob("*") if path.is_file()}
    added = {"camera_gt.json", "000000/scene_gt_camera.json"}
    added |= {f"000000/range/{view:06d}.tiff" for view in range(2)}
    assert {str(name) for name in names - others} == added
    differing = {
        str(name) for name in others if (out / name).read_bytes() != (plain / name).read_bytes()
    }
    assert differing == {"camera.json", "000000/scene_camera.json", "manifest.json"}
    assert not {"calibration", "dataset"} & table(plain / "manifest.json")["spec"].keys()


def test_range_files_hold_metres_and_the_stated_number(dataset):
    _, out, _ = dataset
    assert table(out / "camera.json")["hole_value"] == "-9999"
    path = out / "000000/range/000000.tiff"
    values = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    depth = cv2.imread(str(out / "000000/depth/000000.png"), cv2.IMREAD_UNCHANGED)
    scale_m = table(out / "camera.json")["depth_scale"] / 1000
    np.testing.assert_array_equal(values == -9999, depth == 0)
    known = depth > 0
    np.testing.assert_allclose(values[known], depth[known] * scale_m, atol=0.51 * scale_m)
    camera = read_camera(out / "camera.json")
    points_m = read_range(path, shape=values.shape, camera=camera)
    np.testing.assert_array_equal(np.isnan(points_m[..., 2]), ~known)


def test_a_rendered_view_has_both_cameras():
    scene = synth.make_scene(spec_of(calibration=ERRORS))
    view = scene.render(1)
    assert view.exact_camera == PRESETS["imp"].camera
    assert view.camera == scene.camera == reported_camera(scene.spec, view.exact_camera)
    assert 0.0 < angle_deg(view.pose, view.exact_pose) < 3.0


@pytest.mark.parametrize(
    ("tables", "words"),
    [
        ({"dataset": {"hole_value": -1}}, "dataset.hole_value: expected"),
        ({"calibration": {"focal": -0.1}}, "calibration.focal: expected"),
        ({"noise": {"kind": "tof", "options": {"footprint_px": 0.5}}}, "noise.options"),
        ({"noise": {"kind": "lidar", "options": {"lines": 0.5}}}, "unknown key 'lines'"),
    ],
)
def test_a_misuse_is_one_line(tables, words):
    with pytest.raises(SpecError, match=words):
        spec_of(**tables)
