"""Datasets: the same bytes whatever the processes, interruptions resumed, strangers refused."""

import json
import shutil

import cv2
import msgspec
import numpy as np
import pytest

from synth.camera.presets import PRESETS
from synth.dataset.depth import depth_scale_mm, encode_depth
from synth.dataset.generate import generate_dataset
from synth.dataset.layout import PARTIAL, scene_number
from synth.errors import SpecError
from synth.scene.scene import build_scene
from synth.spec import SceneSpec
from synth.spec.rocks import RocksSpec
from synth.spec.view import CameraSpec, ViewsSpec
from tests.digests import digests

SPEC = SceneSpec(
    seed=6,
    scenes=2,
    rocks=RocksSpec(count=3, family="rounded-box", spacing=1.0),
    camera=CameraSpec(preset="imp"),
    views=ViewsSpec(count=2),
)


@pytest.fixture(scope="module")
def dataset(tmp_path_factory):
    out = tmp_path_factory.mktemp("one") / "dataset"
    generate_dataset(SPEC, out, jobs=1)
    return out


def test_two_processes_give_the_same_bytes(dataset, tmp_path):
    generate_dataset(SPEC, tmp_path / "two", jobs=2)
    assert digests(tmp_path / "two") == digests(dataset)


def test_further_jobs_make_the_rocks_of_one_scene_to_the_same_bytes(tmp_path):
    rocks = RocksSpec(count=4, series="random", spacing=1.0)
    spec = msgspec.structs.replace(SPEC, scenes=1, rocks=rocks, views=ViewsSpec(count=1))
    for jobs in (1, 2):
        generate_dataset(spec, tmp_path / f"{jobs}", jobs=jobs)
    assert digests(tmp_path / "2") == digests(tmp_path / "1")


def test_an_interrupted_run_goes_on_to_the_same_bytes(dataset, tmp_path):
    out = tmp_path / "cut"
    shutil.copytree(dataset, out)
    manifest = json.loads((out / "manifest.json").read_text())
    shutil.rmtree(out / "000001")
    (out / "manifest.json").unlink()
    (out / "camera.json").unlink()
    (out / PARTIAL / "000001" / "gray").mkdir(parents=True)
    identity = {key: value for key, value in manifest.items() if key != "files"}
    (out / PARTIAL / "identity.json").write_text(json.dumps(identity))
    before = (out / "000000" / "gray" / "000000.png").stat().st_mtime_ns
    generate_dataset(SPEC, out)
    assert digests(out) == digests(dataset)
    assert (out / "000000" / "gray" / "000000.png").stat().st_mtime_ns == before


def test_a_whole_dataset_is_left_alone(dataset):
    before = (dataset / "manifest.json").stat().st_mtime_ns
    generate_dataset(SPEC, dataset)
    assert (dataset / "manifest.json").stat().st_mtime_ns == before


def _written_ns(out, index):
    """When a scene was written; a folder's number would not do, since it may be given out again."""
    return (out / scene_number(index) / "scene_gt_shape.json").stat().st_mtime_ns


@pytest.mark.parametrize(
    ("lost", "again"),
    [
        ("000001/mask/000001_000002.png", [1]),
        ("models/obj_000002.ply", [0]),
        ("contact_sheet.png", []),
    ],
)
def test_what_a_whole_dataset_has_lost_is_made_again(dataset, tmp_path, capsys, lost, again):
    out = tmp_path / "gaps"
    shutil.copytree(dataset, out)
    (out / lost).unlink()
    before = [_written_ns(out, index) for index in range(2)]
    generate_dataset(SPEC, out, show_progress=True)
    after = [_written_ns(out, index) for index in range(2)]
    assert [index for index in range(2) if before[index] != after[index]] == again
    assert digests(out) == digests(dataset)
    assert f"{lost} is missing" in capsys.readouterr().err.splitlines()[0]


def test_a_run_that_fails_at_once_leaves_nothing(tmp_path):
    tight = SceneSpec(
        scenes=3,
        rocks=RocksSpec(count=40, family="rounded-box", series="random"),
        camera=CameraSpec(preset="imp"),
    )
    (tmp_path / "empty").mkdir()
    for name in ("new", "empty"):
        with pytest.raises(SpecError, match="full"):
            generate_dataset(tight, tmp_path / name, jobs=2)
    assert not (tmp_path / "new").exists()
    assert not any((tmp_path / "empty").iterdir())


def test_odd_folders_are_refused(tmp_path):
    (tmp_path / "nowhere").symlink_to(tmp_path / "absent")
    (tmp_path / "file").write_text("mine")
    (tmp_path / "odd" / "manifest.json").mkdir(parents=True)
    (tmp_path / "bare").mkdir()
    (tmp_path / "bare" / "manifest.json").write_text("{}")
    for name, words in (
        ("nowhere", "found a link to nowhere"),
        ("file/within", "expected a folder to write to"),
        ("odd", "found other files"),
        ("bare", "found one with None"),
    ):
        with pytest.raises(SpecError, match=words):
            generate_dataset(SPEC, tmp_path / name)
    assert not (tmp_path / "absent").exists()


def test_another_spec_or_other_files_are_refused(dataset, tmp_path):
    other = SceneSpec(seed=7)
    with pytest.raises(SpecError, match=r"with spec\.seed 7, found one with "):
        generate_dataset(other, dataset)
    (tmp_path / "note.txt").write_text("mine")
    with pytest.raises(SpecError, match="found other files"):
        generate_dataset(SPEC, tmp_path)
    with pytest.raises(SpecError, match="found a file"):
        generate_dataset(SPEC, tmp_path / "note.txt")


def test_manifest_names_every_file(dataset):
    manifest = json.loads((dataset / "manifest.json").read_text())
    found = digests(dataset)
    del found["manifest.json"]
    assert manifest["files"] == found
    assert manifest["backend"] in ("osmesa", "egl", "embree")


def test_tables_and_images_agree(dataset):
    folder = dataset / "000001"
    gt = json.loads((folder / "scene_gt.json").read_text())
    info = json.loads((folder / "scene_gt_info.json").read_text())
    coco = json.loads((folder / "scene_gt_coco.json").read_text())
    shape = json.loads((folder / "scene_gt_shape.json").read_text())
    models = json.loads((dataset / "models" / "models_info.json").read_text())
    assert [rock["obj_id"] for rock in shape["rocks"]] == [1001, 1002, 1003]
    assert set(models) == {"1", "2", "3", "1001", "1002", "1003"}
    for view in range(2):
        labels = cv2.imread(str(folder / "labels" / f"{view:06d}.png"), cv2.IMREAD_UNCHANGED)
        assert labels.dtype == np.uint16
        for instance, entry in enumerate(gt[str(view)]):
            assert entry["obj_id"] == shape["rocks"][instance]["obj_id"]
            name = f"{view:06d}_{instance:06d}.png"
            visible = cv2.imread(str(folder / "mask_visib" / name), cv2.IMREAD_UNCHANGED) == 255
            np.testing.assert_array_equal(visible, labels == instance + 1)
            assert info[str(view)][instance]["px_count_visib"] == visible.sum() > 0
    for annotation in coco["annotations"]:
        counts = annotation["segmentation"]["counts"]
        flat = np.repeat(np.arange(len(counts)) % 2, counts)
        mask = flat.reshape(annotation["segmentation"]["size"], order="F")
        path = folder / "labels" / f"{annotation['image_id']:06d}.png"
        labels = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
        instance = annotation["category_id"] - 1000
        np.testing.assert_array_equal(mask, labels == instance)
        assert annotation["area"] == mask.sum()


def test_depth_image_holds_the_plane(dataset):
    # Ground seen at a pixel's centre: z by the plane; off by half a depth step and OpenGL's step.
    folder = dataset / "000000"
    camera = PRESETS["imp"].camera
    view = json.loads((folder / "scene_camera.json").read_text())["1"]
    depth = cv2.imread(str(folder / "depth" / "000001.png"), cv2.IMREAD_UNCHANGED)
    labels = cv2.imread(str(folder / "labels" / "000001.png"), cv2.IMREAD_UNCHANGED)
    rotation = np.array(view["cam_R_w2c"]).reshape(3, 3)
    centre_mm = -rotation.T @ np.array(view["cam_t_w2c"])
    rows, cols = np.nonzero((labels == 0) & (depth > 0))
    rays = np.column_stack(
        [(cols - camera.cx) / camera.fx, (rows - camera.cy) / camera.fy, np.ones(len(rows))]
    )
    expected_mm = -centre_mm[2] / (rays @ rotation)[:, 2]
    found_mm = depth[rows, cols] * view["depth_scale"]
    assert np.abs(found_mm - expected_mm).max() < 0.6 * view["depth_scale"]


@pytest.mark.parametrize("preset", ["imp", "msl-navcam"])
@pytest.mark.parametrize(("elevation_deg", "count"), [(32.0, 4), (8.0, 2), (5.0, 2)])
def test_depth_scale_reaches_every_rock(preset, elevation_deg, count):
    spec = SceneSpec(
        rocks=RocksSpec(family="rounded-box", count=4, spacing=1.0),
        camera=CameraSpec(preset=preset, elevation_deg=elevation_deg),
        views=ViewsSpec(count=count),
    )
    reach_m = depth_scale_mm(spec) * 65.535
    for index in range(3):
        scene = build_scene(spec, index)
        for pose in scene.poses:
            for placed in scene.rocks:
                assert pose.camera_points_m(placed.mesh.vertices_m)[:, 2].max() < reach_m


def test_depth_out_of_reach_is_zero():
    np.testing.assert_array_equal(
        encode_depth(np.array([[np.nan, 6.5535, 6.5536]]), 0.1), [[0, 65535, 0]]
    )
