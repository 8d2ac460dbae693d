"""Files of the splits: merged COCO and YOLO labels, read as trainers read them."""

import contextlib
import io
import json

import cv2
import numpy as np
import pytest
from matplotlib.path import Path as Outline
from pycocotools.coco import COCO

from synth.dataset.generate import generate_dataset
from synth.dataset.yolo import mask_polygon
from synth.errors import SpecError
from synth.spec import SceneSpec, convert_spec
from synth.spec.dataset import DatasetSpec
from synth.spec.rocks import RocksSpec
from synth.spec.view import CameraSpec, ViewsSpec

SPEC = SceneSpec(
    seed=4,
    scenes=3,
    rocks=RocksSpec(count=3, family="rounded-box", spacing=1.0),
    camera=CameraSpec(preset="imp", elevation_deg=10.0),
    views=ViewsSpec(count=2),
    dataset=DatasetSpec(split=0.67, yolo=True),
)


@pytest.fixture(scope="module")
def dataset(tmp_path_factory):
    out = tmp_path_factory.mktemp("splits") / "dataset"
    generate_dataset(SPEC, out)
    return out


def labels_of(dataset, scene, view):
    path = dataset / f"{scene:06d}" / "labels" / f"{view:06d}.png"
    return cv2.imread(str(path), cv2.IMREAD_UNCHANGED)


@pytest.mark.filterwarnings(  # pycocotools 2.0.11's own, against numpy 2
    "ignore:__array__ implementation doesn't accept a copy keyword:DeprecationWarning"
)
def test_merged_coco_holds_every_view_of_its_scenes_once(dataset):
    views = {}
    for split, expected in (("train", [0, 1]), ("val", [2])):
        with contextlib.redirect_stdout(io.StringIO()):
            coco = COCO(str(dataset / "coco" / f"{split}.json"))
        assert [category["name"] for category in coco.loadCats(coco.getCatIds())] == ["rock"]
        assert len(coco.getImgIds()) == 2 * len(expected)
        ids = [annotation["id"] for annotation in coco.dataset["annotations"]]
        assert len(set(ids)) == len(ids)
        for image in coco.loadImgs(coco.getImgIds()):
            assert (dataset / image["file_name"]).is_file()
            labels = labels_of(dataset, int(image["scene"]), image["view"])
            found = np.zeros(labels.shape, dtype=int)
            for annotation in coco.loadAnns(coco.getAnnIds([image["id"]])):
                found[coco.annToMask(annotation) > 0] = annotation["instance"] + 1
            np.testing.assert_array_equal(found, labels)
            views[image["file_name"]] = int(image["scene"])
        assert {views[image["file_name"]] for image in coco.dataset["images"]} == set(expected)
    assert len(views) == 6


def filled(line, shape):
    """Return the pixels whose centres a label line's polygon holds, by the even-odd rule."""
    values = np.array([float(value) for value in line.split()[1:]]).reshape(-1, 2)
    corners = values * shape[::-1]
    # Crossings of each pixel's centre with the polygon to its right, counted one by one.
    rows, cols = (np.indices(shape) + 0.5).reshape(2, -1)
    count = np.zeros(len(rows), dtype=int)
    for (x1, y1), (x2, y2) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if y1 != y2:
            crossed = (y1 > rows) != (y2 > rows)
            count += crossed & (x1 + (rows - y1) / (y2 - y1) * (x2 - x1) > cols)
    return (count % 2 == 1).reshape(shape)


def test_yolo_labels_hold_the_seen_pixels(dataset):
    text = (dataset / "yolo" / "data.yaml").read_text()
    assert text == "train: images/train\nval: images/val\nnames:\n  0: rock\n"
    for split, scenes in (("train", (0, 1)), ("val", (2,))):
        files = sorted(path.stem for path in (dataset / "yolo" / "labels" / split).iterdir())
        assert files == [f"{scene:06d}_{view:06d}" for scene in scenes for view in range(2)]
        for stem in files:
            scene, view = map(int, stem.split("_"))
            picture = dataset / "yolo" / "images" / split / f"{stem}.png"
            original = dataset / f"{scene:06d}" / "gray" / f"{view:06d}.png"
            assert picture.read_bytes() == original.read_bytes()
            labels = labels_of(dataset, scene, view)
            lines = (dataset / "yolo" / "labels" / split / f"{stem}.txt").read_text().splitlines()
            assert len(lines) == len(np.unique(labels[labels > 0]))
            for line, label in zip(lines, np.unique(labels[labels > 0]), strict=True):
                assert line.startswith("0 ")
                np.testing.assert_array_equal(filled(line, labels.shape), labels == label)


def test_one_polygon_holds_parts_and_leaves_holes_out():
    mask = np.zeros((12, 20), dtype=bool)
    mask[0:8, 0:9] = True
    mask[3:5, 3:6] = False
    mask[2:11, 14:20] = True
    polygon = mask_polygon(mask)
    assert polygon.min() >= 0.0
    assert (polygon.max(axis=0) <= [20.0, 12.0]).all()
    line = "0 " + " ".join(str(value) for value in (polygon / [20.0, 12.0]).ravel())
    np.testing.assert_array_equal(filled(line, mask.shape), mask)
    assert Outline(polygon).contains_point((1.5, 1.5))


def test_a_dataset_without_the_table_has_no_files_of_splits(tmp_path):
    spec = convert_spec({"rocks": {"count": 1}, "camera": {"preset": "imp"}}, where="test")
    generate_dataset(spec, tmp_path / "plain")
    assert not (tmp_path / "plain" / "coco").exists()
    assert "dataset" not in json.loads((tmp_path / "plain" / "manifest.json").read_text())["spec"]


def test_yolo_without_a_split_is_refused():
    with pytest.raises(SpecError, match=r"dataset\.yolo: expected a split"):
        convert_spec({"dataset": {"yolo": True}}, where="test")


@pytest.mark.parametrize("family", ["realistic", "ellipsoid", "perturbed", "mixed"])
def test_a_family_that_cannot_be_graded_needs_no_series(family):
    assert convert_spec({"rocks": {"family": family}}, where="test").rocks.series == "random"
    assert convert_spec({}, where="test").rocks.series == "graded"
    with pytest.raises(SpecError, match=r"rocks\.series: expected one of .*'graded'"):
        convert_spec({"rocks": {"family": family, "series": "graded"}}, where="test")
