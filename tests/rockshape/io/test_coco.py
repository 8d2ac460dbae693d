"""COCO annotations: each rock's own mask, with the id that the file gives it."""

import json
from pathlib import Path

import numpy as np
import pytest
from pycocotools import mask as coco_mask

from rockshape.errors import InputError
from rockshape.inputs.arrays import observe
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
        ([annotation(1, [[1, 2, 3, 4]])], "1 of 1 annotations left out: 1 of fewer than three"),
        ([annotation(4, SQUARE), annotation(4, SQUARE)], "expected ids that differ, found 4 twice"),
        ([annotation(1, {"size": [9, 9], "counts": [81]})], r"run lengths over \(140, 200\)"),
        ([annotation(1, {"size": [140, 200], "counts": [-5, 28005]})], "negative run lengths"),
        ([annotation(1, {"size": [140, 200], "counts": [5, 28005]})], "over 28010 pixels"),
        ([annotation(1, {"size": [140, 200], "counts": "0"})], "over 0 pixels in place of 28000"),
        ([annotation(1, {"size": [140, 200], "counts": "\x7f"})], "damaged compressed run"),
        ([annotation(1, {"size": [140, 200], "counts": "oooooooooooo"})], "damaged compressed"),
        ([annotation(1, {"size": [140, 200], "counts": "PPo"})], "end within a count"),
        ([annotation(1, {"size": [140, 200], "counts": [0.5]})], "no run lengths"),
        ([{"id": 1, "image_id": 1}], "1 without segmentation"),
    ],
)
def test_what_is_no_annotation_is_refused(
    tmp_path: Path, annotations: list[dict[str, object]], says: str
) -> None:
    path = write(tmp_path, *annotations)
    with pytest.raises(InputError, match=rf"rocks\.json: .*{says}"):
        read_labels(path, shape=SHAPE)


def test_what_cannot_be_read_is_left_out_and_told(tmp_path: Path) -> None:
    path = write(
        tmp_path,
        annotation(11, SQUARE),
        {"id": 12, "image_id": 1},
        annotation(13, [[1, 2, 3, 4]]),
        annotation(14, [[1, 2, 3, 4, 5]]),
        annotation(15, None),
        annotation(16, [[500, 500, 510, 500, 510, 510]]),
        annotation(17, [[0, 0, "x", 4, 5, 6]]),
        annotation(18, SQUARE) | {"iscrowd": 1},
        annotation(19, [[0, 0, 9, 9], *SQUARE]),
    )
    instances = read_labels(path, shape=SHAPE)
    assert [each.id for each in instances] == [11, 19]
    (note,) = instances.notes
    assert note == (
        "rocks.json: 7 of 9 annotations left out: 2 without segmentation (12, 15), "
        "1 of fewer than three corners (13), 2 without a polygon (14, 17), "
        "1 without a pixel in the image (16), 1 crowd (18)"
    )


def test_many_that_are_left_out_are_counted_and_some_named(tmp_path: Path) -> None:
    bare = [{"id": number, "image_id": 1} for number in range(2, 90)]
    instances = read_labels(write(tmp_path, annotation(1, SQUARE), *bare), shape=SHAPE)
    assert instances.notes[0].endswith("88 without segmentation (2, 3, 4, 5, 6, ...)")


@pytest.mark.parametrize(
    ("ids", "expected"),
    [
        ((0, 5), [0, 5]),
        (("12", "7"), [7, 12]),
        ((3.0, 2), [2, 3]),
        ((-4, 2), [-4, 2]),
        (("a", "b"), [1, 2]),
        ((None, None), [1, 2]),
        ((2**70, 1), [1, 2]),
        ((True, 4), [1, 2]),
    ],
)
def test_ids_of_any_kind(tmp_path: Path, ids: tuple[object, ...], expected: list[int]) -> None:
    path = write(tmp_path, *(annotation(number, SQUARE) for number in ids))
    instances = read_labels(path, shape=SHAPE)
    assert [each.id for each in instances] == expected
    renumbered = expected == [1, 2] and ids != (None, None)
    assert bool(instances.notes) == renumbered


def test_nothing_of_other_images_matters(tmp_path: Path) -> None:
    path = tmp_path / "rocks.json"
    images = [IMAGE, {"id": "x"}, {"id": 7, "file_name": 8, "width": "?"}, 5, None]
    others = [
        {"id": 1, "image_id": 7, "segmentation": {"size": [1, 1], "counts": [-1]}},
        {"id": "y", "image_id": 9, "segmentation": 3},
        "no annotation",
        annotation(2**80, [[float("nan")]], image=9),
    ]
    annotations = [*others, annotation(1, SQUARE)]
    path.write_text(json.dumps({"images": images, "annotations": annotations}))
    instances = read_labels(path, shape=SHAPE, image_name="scene.png")
    assert [each.id for each in instances] == [1]
    assert instances.notes == ()


def test_the_image_is_told_by_its_name_without_its_suffix_or_by_its_size(tmp_path: Path) -> None:
    path = tmp_path / "rocks.json"
    twin = IMAGE | {"id": 2, "file_name": "other/scene.png", "width": 9}
    annotations = [annotation(1, SQUARE), annotation(2, SQUARE, image=2)]
    path.write_text(json.dumps({"images": [IMAGE, twin], "annotations": annotations}))
    for name in ("scene.png", "scene.tif"):
        found = read_labels(path, shape=SHAPE, image_name=name)
        assert [each.id for each in found] == [1]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-32"])
def test_any_unicode_is_read(tmp_path: Path, encoding: str) -> None:
    path = write(tmp_path, annotation(5, SQUARE))
    path.write_text(path.read_text(), encoding=encoding)
    assert [each.id for each in read_labels(path, shape=SHAPE)] == [5]


@pytest.mark.filterwarnings("ignore:__array__ implementation:DeprecationWarning")
@pytest.mark.parametrize("size", [(7, 5), (140, 200), (1, 1), (300, 2)])
def test_compressed_run_lengths_are_pycocotools(
    tmp_path: Path, rng: np.random.Generator, size: tuple[int, int]
) -> None:
    for density in (0.001, 0.1, 0.5, 0.95):
        mask = rng.random(size) < density
        mask[-1, -1] = True
        theirs = coco_mask.encode(np.asfortranarray(mask.view(np.uint8)))
        packed = {"size": list(size), "counts": theirs["counts"].decode()}
        path = tmp_path / "rocks.json"
        image = IMAGE | {"height": size[0], "width": size[1]}
        path.write_text(json.dumps({"images": [image], "annotations": [annotation(1, packed)]}))
        (instance,) = read_labels(path, shape=size)
        whole = np.zeros(size, dtype=bool)
        whole[instance.window] = instance.mask
        np.testing.assert_array_equal(whole, mask)


@pytest.mark.filterwarnings("ignore:__array__ implementation:DeprecationWarning")
def test_polygons_are_pycocotools_within_a_pixel_row(
    tmp_path: Path, rng: np.random.Generator
) -> None:
    for step in (1, 0.5, 0.001):
        angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)
        radii = rng.uniform(30, 40, 24)
        corners = np.c_[100 + radii * np.cos(angles), 70 + radii * np.sin(angles)]
        corners = np.rint(corners / step) * step
        polygon = [corners.ravel().tolist()]
        theirs = coco_mask.decode(coco_mask.frPyObjects(polygon, *SHAPE))[..., 0].astype(bool)
        (instance,) = read_labels(write(tmp_path, annotation(1, polygon)), shape=SHAPE)
        whole = np.zeros(SHAPE, dtype=bool)
        whole[instance.window] = instance.mask
        perimeter = np.hypot(*(corners - np.roll(corners, 1, axis=0)).T).sum()
        assert (whole != theirs).sum() < 0.12 * perimeter  # theirs snaps edges to fifths of a pixel
        assert abs(whole.sum() - theirs.sum()) < 0.07 * perimeter


def test_half_pixel_corners_are_counted_on_one_side(tmp_path: Path) -> None:
    square = [[49.5, 69.5, 59.5, 69.5, 59.5, 79.5, 49.5, 79.5]]
    (instance,) = read_labels(write(tmp_path, annotation(1, square)), shape=SHAPE)
    assert instance.window == (slice(70, 80), slice(50, 60))
    assert instance.mask.all()


def test_one_image_of_segment_anythings_data_set(tmp_path: Path) -> None:
    # SA-1B: an object `image`, annotations that name no image
    path = tmp_path / "sa_1.json"
    image = {"image_id": 1, "width": SHAPE[1], "height": SHAPE[0], "file_name": "sa_1.jpg"}
    mask = disc(70, 70, 30)
    theirs = coco_mask.encode(np.asfortranarray(mask.view(np.uint8)))
    packed = {"size": list(SHAPE), "counts": theirs["counts"].decode()}
    entry = {"id": 390, "bbox": [], "predicted_iou": 0.9, "segmentation": packed}
    path.write_text(json.dumps({"image": image, "annotations": [entry]}))
    (instance,) = read_labels(path, shape=SHAPE, image_name="sa_1.jpg")
    assert instance.id == 390
    assert instance.mask.sum() == mask.sum()
