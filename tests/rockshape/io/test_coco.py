"""COCO annotations: each rock's own mask, with the id that the file gives it."""

import json
from pathlib import Path

import numpy as np
import pytest
from pycocotools import mask as coco_mask

from rockshape.api import observe
from rockshape.errors import InputError
from rockshape.io import read_labels
from rockshape.pipeline import measure

SHAPE = (140, 200)
IMAGE = {"id": 1, "width": SHAPE[1], "height": SHAPE[0], "file_name": "folder/scene.png"}
ROWS, COLS = np.mgrid[: SHAPE[0], : SHAPE[1]]


def disc(row: float, col: float, radius: float) -> np.ndarray:
    return (ROWS - row) ** 2 + (COLS - col) ** 2 <= radius**2


def run_lengths(mask: np.ndarray) -> dict[str, object]:
    flat = np.concatenate([[False], mask.ravel(order="F"), [False]])
    edges = [0, *np.flatnonzero(flat[1:] != flat[:-1]).tolist(), mask.size]
    return {"size": list(mask.shape), "counts": np.diff(edges).tolist()}


def annotation(number: object, segmentation: object, image: int = 1) -> dict[str, object]:
    return {"id": number, "image_id": image, "segmentation": segmentation}


def write(folder: Path, *annotations: dict[str, object]) -> Path:
    path = folder / "rocks.json"
    path.write_text(json.dumps({"images": [IMAGE], "annotations": annotations}))
    return path


def test_overlapping_rocks_keep_their_own_masks(tmp_path: Path) -> None:
    masks = [disc(70, 70, 50), disc(70, 120, 50)]
    assert (masks[0] & masks[1]).any()
    path = write(tmp_path, *(annotation(n, run_lengths(m)) for n, m in enumerate(masks, start=1)))
    instances = read_labels(path, shape=SHAPE)
    for instance, mask in zip(instances, masks, strict=True):
        whole = np.zeros(SHAPE, dtype=bool)
        whole[instance.window] = instance.mask
        np.testing.assert_array_equal(whole, mask)
    image = np.zeros(SHAPE, dtype=np.uint8)
    rocks = measure(observe(image, labels=instances), method="robust").rocks
    assert [rock.area_px for rock in rocks] == [mask.sum() for mask in masks]
    # a disc is as long as wide, but for its pixels
    assert [rock.values["axis_ratio"] for rock in rocks] == pytest.approx([1, 1], abs=0.005)


def test_ids_are_those_of_the_file_in_their_order(tmp_path: Path) -> None:
    ids = (909000412806, 0, 2**31, 7)
    square = [[10, 20, 30, 20, 30, 60, 10, 60]]
    path = write(tmp_path, *(annotation(number, square) for number in ids))
    instances = read_labels(path, shape=SHAPE)
    assert [each.id for each in instances] == sorted(ids)
    image = np.zeros(SHAPE, dtype=np.uint8)
    frame = measure(observe(image, labels=instances), method="robust").to_frame()
    assert frame["rock"].tolist() == sorted(ids)


def test_a_polygons_pixels_are_those_whose_centres_it_holds(tmp_path: Path) -> None:
    # two pieces of one rock; corners are pixel corners: columns 10 to 29 and 40 to 44
    pieces = [[10, 20, 30, 20, 30, 60, 10, 60], [40, 20, 45, 20, 45, 22, 40, 22]]
    (instance,) = read_labels(write(tmp_path, annotation(3, pieces)), shape=SHAPE)
    expected = np.zeros(SHAPE, dtype=bool)
    expected[20:60, 10:30] = True
    expected[20:22, 40:45] = True
    assert instance.window == (slice(20, 60), slice(10, 45))
    np.testing.assert_array_equal(instance.mask, expected[instance.window])


@pytest.mark.filterwarnings("ignore:__array__ implementation:DeprecationWarning")
def test_run_lengths_are_pycocotools(tmp_path: Path) -> None:
    mask = disc(40, 160, 30)
    theirs = coco_mask.decode(coco_mask.frPyObjects(run_lengths(mask), *SHAPE)).astype(bool)
    (instance,) = read_labels(write(tmp_path, annotation(3, run_lengths(mask))), shape=SHAPE)
    whole = np.zeros(SHAPE, dtype=bool)
    whole[instance.window] = instance.mask
    np.testing.assert_array_equal(whole, theirs)


def test_an_annotation_without_pixels_is_no_rock(tmp_path: Path) -> None:
    outside = [[500, 500, 510, 500, 510, 510]]
    empty = run_lengths(np.zeros(SHAPE, dtype=bool))
    path = write(tmp_path, annotation(1, outside), annotation(2, empty), annotation(3, []))
    assert len(read_labels(path, shape=SHAPE)) == 0


def test_only_the_named_images_annotations_are_read(tmp_path: Path) -> None:
    square = [[10, 20, 30, 20, 30, 60, 10, 60]]
    path = tmp_path / "rocks.json"
    other = IMAGE | {"id": 2, "file_name": "C:\\pictures\\other.png", "height": 9}
    annotations = [annotation(1, square), annotation(2, square, image=2)]
    path.write_text(json.dumps({"images": [IMAGE, other], "annotations": annotations}))
    found = read_labels(path, shape=SHAPE, image_name="scene.png")
    assert [each.id for each in found] == [1]
    found = read_labels(path, shape=(9, SHAPE[1]), image_name="other.png")
    assert len(found) == 0  # the square lies below its nine rows
    with pytest.raises(InputError, match=r"one image named third\.png, found 0"):
        read_labels(path, shape=SHAPE, image_name="third.png")
    with pytest.raises(InputError, match=r"expected \(1, 1\) as the image has, found \(140, 200\)"):
        read_labels(path, shape=(1, 1), image_name="scene.png")


SQUARE = [[10, 20, 30, 20, 30, 60, 10, 60]]


@pytest.mark.parametrize(
    ("annotations", "says"),
    [
        ([annotation(1, [[1, 2, 3, 4]])], "annotation 1: expected polygons of three points"),
        ([annotation(-1, SQUARE)], r">= 0.*annotations\[0\]\.id"),
        ([annotation(2**63, SQUARE)], r"annotations\[0\]\.id"),
        ([annotation("one", SQUARE)], r"annotations\[0\]\.id"),
        ([annotation(4, SQUARE), annotation(4, SQUARE)], "expected ids that differ, found 4 twice"),
        ([annotation(1, {"size": [9, 9], "counts": [81]})], r"run lengths over \(140, 200\)"),
        ([annotation(1, {"size": [140, 200], "counts": [-5, 28005]})], "run lengths over"),
        ([{"id": 1, "image_id": 1}], "segmentation"),
    ],
)
def test_what_is_no_annotation_is_refused(
    tmp_path: Path, annotations: list[dict[str, object]], says: str
) -> None:
    path = write(tmp_path, *annotations)
    with pytest.raises(InputError, match=rf"rocks\.json: .*{says}"):
        read_labels(path, shape=SHAPE)
