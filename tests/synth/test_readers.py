"""Others' readers: pycocotools as it is, and BOP's format read by its own documentation."""

import contextlib
import io
import json

import cv2
import numpy as np
import pytest
import trimesh
from pycocotools.coco import COCO

from synth.dataset.generate import generate_dataset
from synth.spec import SceneSpec
from synth.spec.rocks import RocksSpec
from synth.spec.sensor import NoiseSpec
from synth.spec.view import CameraSpec, ViewsSpec

SPEC = SceneSpec(
    seed=11,
    rocks=RocksSpec(count=3, family="rounded-box", spacing=1.0),
    camera=CameraSpec(preset="imp"),
    views=ViewsSpec(count=2),
    noise=NoiseSpec(kind="stereo", min_texture=0.0),
)


@pytest.fixture(scope="module")
def dataset(tmp_path_factory):
    out = tmp_path_factory.mktemp("readers") / "dataset"
    generate_dataset(SPEC, out)
    return out


def image_of(path):
    return cv2.imread(str(path), cv2.IMREAD_UNCHANGED)


def table_of(path):
    return json.loads(path.read_text())


def views_of(dataset):
    """Yield each view's parts as BOP documents them: camera, poses, info, stem of the files."""
    scene = dataset / "000000"
    cameras, poses, infos = (
        table_of(scene / f"scene_{name}.json") for name in ("camera", "gt", "gt_info")
    )
    assert set(cameras) == set(poses) == set(infos) == {"0", "1"}
    for number in cameras:
        yield scene, cameras[number], poses[number], infos[number], f"{int(number):06d}"


@pytest.mark.filterwarnings(  # pycocotools 2.0.11's own, against numpy 2
    "ignore:__array__ implementation doesn't accept a copy keyword:DeprecationWarning"
)
def test_pycocotools_reads_what_is_seen(dataset):
    with contextlib.redirect_stdout(io.StringIO()):
        coco = COCO(str(dataset / "000000" / "scene_gt_coco.json"))
    assert sorted(coco.getImgIds()) == [0, 1]
    assert coco.getAnnIds()
    for number in coco.getImgIds():
        picture = image_of(dataset / "000000" / coco.loadImgs([number])[0]["file_name"])
        for annotation in coco.loadAnns(coco.getAnnIds([number])):
            mask = coco.annToMask(annotation)
            assert mask.shape == picture.shape
            instance = annotation["category_id"] - 1
            name = f"{number:06d}_{instance:06d}.png"
            seen = image_of(dataset / "000000" / "mask_visib" / name) > 0
            np.testing.assert_array_equal(mask > 0, seen)
            assert annotation["area"] == seen.sum() > 0
            left, top, width, height = annotation["bbox"]
            rows, cols = np.nonzero(seen)
            assert (left, top) == (cols.min(), rows.min())
            assert (left + width, top + height) == (cols.max() + 1, rows.max() + 1)


def test_models_in_millimetres_project_onto_their_masks(dataset):
    info = table_of(dataset / "models" / "models_info.json")
    for scene, camera, poses, _, stem in views_of(dataset):
        matrix = np.array(camera["cam_K"]).reshape(3, 3)
        for instance, pose in enumerate(poses):
            name = f"obj_{pose['obj_id']:06d}.ply"
            model = trimesh.load(dataset / "models" / name, process=False)
            size = [info[str(pose["obj_id"])][f"size_{axis}"] for axis in "xyz"]
            # PLY holds 32-bit floats.
            np.testing.assert_allclose(np.ptp(model.vertices, axis=0), size, rtol=1e-6)
            rotation = np.array(pose["cam_R_m2c"]).reshape(3, 3)
            np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-10)
            points_mm = model.vertices @ rotation.T + pose["cam_t_m2c"]
            pixels = points_mm @ matrix.T
            pixels = pixels[:, :2] / pixels[:, 2:]
            mask = image_of(scene / "mask" / f"{stem}_{instance:06d}.png") > 0
            # A pixel is in where its centre is: the mask keeps within one pixel of the model.
            near = cv2.dilate(mask.astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
            columns, rows = np.rint(pixels).astype(int).T
            assert near[rows, columns].all()
            rows, columns = np.nonzero(mask)
            low, high = pixels.min(axis=0), pixels.max(axis=0)
            assert np.abs(low - [columns.min(), rows.min()]).max() <= 1.0
            assert np.abs(high - [columns.max(), rows.max()]).max() <= 1.0
            depth = image_of(scene / "depth_true" / f"{stem}.png") * camera["depth_scale"]
            seen = depth[image_of(scene / "mask_visib" / f"{stem}_{instance:06d}.png") > 0]
            assert seen.min() > points_mm[:, 2].min() - camera["depth_scale"]
            assert seen.max() < points_mm[:, 2].max() + camera["depth_scale"]


def test_poses_to_the_world_agree_between_views(dataset):
    places = []
    for _, camera, poses, _, _ in views_of(dataset):
        rotation = np.array(camera["cam_R_w2c"]).reshape(3, 3)
        translation = np.array(camera["cam_t_w2c"])
        places.append([rotation.T @ (np.array(p["cam_t_m2c"]) - translation) for p in poses])
    # Millimetres, written with 12 digits.
    np.testing.assert_allclose(places[0], places[1], atol=1e-6)


def test_gt_info_counts_the_masks_and_the_depth(dataset):
    for scene, _, _, infos, stem in views_of(dataset):
        depth = image_of(scene / "depth" / f"{stem}.png")
        for instance, info in enumerate(infos):
            whole = image_of(scene / "mask" / f"{stem}_{instance:06d}.png") > 0
            seen = image_of(scene / "mask_visib" / f"{stem}_{instance:06d}.png") > 0
            assert info["px_count_all"] == whole.sum()
            assert info["px_count_visib"] == seen.sum()
            assert info["px_count_valid"] == (whole & (depth > 0)).sum()
            assert info["visib_fract"] == pytest.approx(seen.sum() / whole.sum(), rel=1e-9)
            for key, mask in (("bbox_obj", whole), ("bbox_visib", seen)):
                rows, cols = np.nonzero(mask)
                sides = [np.ptp(cols), np.ptp(rows)]  # BOP's: from the first pixel to the last
                assert info[key] == [cols.min(), rows.min(), *sides]


def test_the_measured_depth_strays_and_the_true_one_is_kept(dataset):
    scene = dataset / "000000"
    for stem in ("000000", "000001"):
        measured, exact = (
            image_of(scene / name / f"{stem}.png") for name in ("depth", "depth_true")
        )
        assert measured.dtype == exact.dtype == np.uint16
        assert (exact > 0).mean() > (measured > 0).mean() > 0.5
        both = (measured > 0) & (exact > 0)
        assert (measured[both] != exact[both]).mean() > 0.5


def test_glb_holds_rocks_and_ground_where_they_lie(dataset):
    scene = trimesh.load(dataset / "000000" / "scene.glb")
    assert set(scene.geometry) == {"rock_000000", "rock_000001", "rock_000002", "ground_000000"}
    shape = table_of(dataset / "000000" / "scene_gt_shape.json")
    for rock in shape["rocks"]:
        name = f"rock_{rock['instance']:06d}"
        body = scene.geometry[name].copy()
        body.apply_transform(scene.graph[name][0])
        x, y, z = rock["centre_m"]
        # glTF has y up: (x, y, z) became (x, z, −y). 32-bit floats; chords for curved parts.
        body.merge_vertices()
        np.testing.assert_allclose(body.center_mass, [x, z, -y], atol=1e-3)


def test_contact_sheet_shows_each_view_twice(dataset):
    sheet = image_of(dataset / "contact_sheet.png")
    assert sheet.shape == (240 + 6, 4 * (240 + 6), 3)
    assert len(np.unique(sheet.reshape(-1, 3), axis=0)) > 100
