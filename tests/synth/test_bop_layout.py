"""The strict BOP layout, against its specification.

https://github.com/thodan/bop_toolkit/blob/master/docs/bop_datasets_format.md
"""

import json
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
import trimesh
from scipy.spatial.distance import pdist

from synth.dataset.generate import generate_dataset
from synth.dataset.integrity import scenes_of
from synth.errors import MissingBackendError, SpecError
from synth.render import choose_backend
from synth.spec import SceneSpec
from synth.spec.dataset import DatasetSpec
from synth.spec.population import PopulationSpec
from synth.spec.rocks import RocksSpec
from synth.spec.view import CameraSpec, ViewsSpec
from tests.digests import digests

SPEC = SceneSpec(
    seed=3,
    scenes=3,
    rocks=RocksSpec(count=3, series="random", spacing=1.0),
    camera=CameraSpec(preset="imp"),
    views=ViewsSpec(count=2),
    dataset=DatasetSpec(layout="bop", split=0.67),
)


@pytest.fixture(scope="module")
def dataset(tmp_path_factory):
    out = tmp_path_factory.mktemp("bop") / "dataset"
    generate_dataset(SPEC, out)
    return out


def table_of(path):
    return json.loads(path.read_text())


def scenes(dataset):
    return sorted((*(dataset / "train").iterdir(), *(dataset / "test").iterdir()))


def test_scenes_lie_in_folders_of_their_splits_with_the_named_files(dataset):
    assert {path.relative_to(dataset).as_posix() for path in scenes(dataset)} == {
        "train/000000",
        "train/000001",
        "test/000002",
    }
    for scene in scenes(dataset):
        for name in ("camera", "gt", "gt_info", "gt_coco"):
            assert set(table_of(scene / f"scene_{name}.json")) >= {"0", "1"} or name == "gt_coco"
        for folder in ("gray", "depth"):
            names = sorted(path.name for path in (scene / folder).iterdir())
            assert names == ["000000.png", "000001.png"]
        for folder in ("mask", "mask_visib"):
            names = {path.name for path in (scene / folder).iterdir()}
            assert names == {f"{v:06d}_{i:06d}.png" for v in range(2) for i in range(3)}
        for camera in table_of(scene / "scene_camera.json").values():
            assert set(camera) == {"cam_K", "depth_scale", "cam_R_w2c", "cam_t_w2c"}
    assert (dataset / "camera.json").is_file()
    assert "0.5" in (dataset / "dataset_info.md").read_text()


def test_all_scenes_show_the_same_objects(dataset):
    for scene in scenes(dataset):
        for poses in table_of(scene / "scene_gt.json").values():
            assert sorted(pose["obj_id"] for pose in poses) == [1, 2, 3]
    assert sorted(path.name for path in (dataset / "models").iterdir()) == [
        "models_info.json",
        *(f"obj_{number:06d}.ply" for number in (1, 2, 3)),
    ]
    places = [table_of(scene / "scene_gt_shape.json")["rocks"] for scene in scenes(dataset)]
    volumes = [[rock["volume_m3"] for rock in rocks] for rocks in places]
    assert volumes[0] == volumes[1] == volumes[2]
    assert places[0][0]["centre_m"] != places[1][0]["centre_m"]


def test_models_are_text_with_their_origin_in_the_middle_of_the_box(dataset):
    info = table_of(dataset / "models" / "models_info.json")
    for number, entry in info.items():
        path = dataset / "models" / f"obj_{int(number):06d}.ply"
        assert path.read_bytes().startswith(b"ply\nformat ascii 1.0\n")
        model = trimesh.load(path, process=False)
        low, high = model.vertices.min(axis=0), model.vertices.max(axis=0)
        np.testing.assert_allclose(low + high, 0.0, atol=1e-4)
        np.testing.assert_allclose([entry[f"min_{axis}"] for axis in "xyz"], low, rtol=1e-6)
        np.testing.assert_allclose([entry[f"size_{a}"] for a in "xyz"], high - low, rtol=1e-6)
        assert entry["diameter"] == pytest.approx(pdist(model.convex_hull.vertices).max())


def test_targets_are_those_that_are_seen_in_the_test_images(dataset):
    scene = dataset / "test" / "000002"
    infos = table_of(scene / "scene_gt_info.json")
    seen = {
        (int(view), instance + 1)
        for view, rocks in infos.items()
        for instance, rock in enumerate(rocks)
        if rock["visib_fract"] >= 0.1
    }
    targets = table_of(dataset / "test_targets_bop19.json")
    assert {(target["im_id"], target["obj_id"]) for target in targets} == seen
    assert {(target["scene_id"], target["inst_count"]) for target in targets} == {(2, 1)}
    assert table_of(dataset / "test_targets_bop24.json") == [
        {"im_id": 0, "scene_id": 2},
        {"im_id": 1, "scene_id": 2},
    ]


@pytest.mark.parametrize("half_px", [0.5, 0.0])
def test_another_renderer_agrees_once_half_a_pixel_is_added(dataset, tmp_path, half_px):
    try:
        choose_backend("osmesa")
    except MissingBackendError:
        pytest.skip("no OSMesa on this machine")
    scene, camera = dataset / "test" / "000002", table_of(dataset / "camera.json")
    pose = table_of(scene / "scene_gt.json")["0"][0]
    model = dataset / "models" / f"obj_{pose['obj_id']:06d}.ply"
    table = {**camera, **pose, "cx": camera["cx"] + half_px, "cy": camera["cy"] + half_px}
    (tmp_path / "pose.json").write_text(json.dumps(table))
    program = Path(__file__).with_name("bop_silhouette.py")
    command = [sys.executable, program, model, tmp_path / "pose.json", tmp_path / "mask.png"]
    subprocess.run(command, check=True)
    theirs, ours = (
        np.argwhere(cv2.imread(str(path), cv2.IMREAD_UNCHANGED) > 0)
        for path in (tmp_path / "mask.png", scene / "mask" / "000000_000000.png")
    )
    # Centroids of many pixels; without the half pixel other centres are asked, at another phase.
    shift = ours.mean(axis=0) - theirs.mean(axis=0)
    np.testing.assert_allclose(shift, 0.5 - half_px, atol=0.03 if half_px else 0.12)
    if half_px:
        both = {tuple(place) for place in ours} ^ {tuple(place) for place in theirs}
        assert len(both) <= 0.003 * len(ours)


def test_a_lost_scene_is_made_again_to_the_same_bytes(dataset, tmp_path):
    out = tmp_path / "again"
    generate_dataset(SPEC, out, jobs=2)
    assert digests(out) == digests(dataset)
    (out / "test" / "000002" / "labels" / "000000.png").unlink()
    generate_dataset(SPEC, out)
    assert digests(out) == digests(dataset)
    assert scenes_of(["test/000002/labels/000000.png", "models/obj_000003.ply"]) == [0, 2]


def test_without_a_split_all_scenes_are_for_testing(tmp_path):
    spec = SceneSpec(
        rocks=RocksSpec(family="ellipsoid", series="random"),
        population=PopulationSpec(kind="golombek-rapp", radius_m=1.5, d_min_m=0.2),
        camera=CameraSpec(preset="imp"),
        views=ViewsSpec(count=1),
        scenes=2,
        dataset=DatasetSpec(layout="bop"),
    )
    generate_dataset(spec, tmp_path / "one")
    assert {path.name for path in (tmp_path / "one" / "test").iterdir()} == {"000000", "000001"}
    ids = [
        {pose["obj_id"] for pose in table_of(scene / "scene_gt.json")["0"]}
        for scene in (tmp_path / "one" / "test").iterdir()
    ]
    assert ids[0] == ids[1] == set(range(1, len(ids[0]) + 1))


def test_a_split_without_scenes_is_refused(tmp_path):
    spec = SceneSpec(scenes=3, dataset=DatasetSpec(split=0.9))
    with pytest.raises(SpecError, match=r"dataset\.split: expected a share that leaves scenes"):
        generate_dataset(spec, tmp_path / "none")
    assert not (tmp_path / "none").exists()
