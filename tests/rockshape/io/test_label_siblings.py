"""Masks of one value, half-pixel corners, overlaps and ids in every label format."""

import json
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest
import roifile
import tifffile
from PIL import Image
from pycocotools import mask as coco_mask

from rockshape.errors import InputError
from rockshape.io import read_labels
from rockshape.rock.given_labels import instances_of
from rockshape.rock.instances import Instances
from tests.rockshape.io.scene_files import run_lengths, saved, written

Save = Callable[[Path, np.ndarray], Path]
SHAPE = (60, 90)
ROWS, COLS = np.mgrid[: SHAPE[0], : SHAPE[1]]


def disc(row: int, col: int, radius: int) -> np.ndarray:
    return (ROWS - row) ** 2 + (COLS - col) ** 2 <= radius**2


APART = [disc(15, 15, 9), disc(20, 60, 14), disc(45, 30, 11)]
MASK = np.where(np.any(APART, axis=0), 255, 0).astype(np.uint8)
MASKS: dict[str, Save] = {
    "PNG": lambda f, v: saved(f / "m.png", Image.fromarray(v).save),
    "PNG of one bit": lambda f, v: saved(f / "m.png", Image.fromarray(v > 0).save),
    "PNG of 16 bits": lambda f, v: saved(
        f / "m.png", lambda at: cv2.imwrite(at, v.astype(np.uint16) * 257)
    ),
    "PNG in colour": lambda f, v: saved(f / "m.png", Image.fromarray(v).convert("RGB").save),
    "TIFF": lambda f, v: saved(f / "m.tif", lambda at: tifffile.imwrite(at, v)),
    "TIFF, white is zero": lambda f, v: saved(
        f / "m.tif", lambda at: tifffile.imwrite(at, v, photometric="miniswhite")
    ),
    "TIFF of one bit": lambda f, v: saved(f / "m.tif", Image.fromarray(v > 0).save),
    "NPY": lambda f, v: saved(f / "m.npy", lambda at: np.save(at, v)),
    "NPY of booleans": lambda f, v: saved(f / "m.npy", lambda at: np.save(at, v > 0)),
    "NPY of floats": lambda f, v: saved(f / "m.npy", lambda at: np.save(at, v / 255.0)),
    "NPZ": lambda f, v: saved(f / "m.npz", lambda at: np.savez(at, labels=v)),
    "NPZ of an unknown key": lambda f, v: saved(f / "m.npz", lambda at: np.savez(at, rocks=v)),
    "PGM": lambda f, v: saved(f / "m.pgm", lambda at: cv2.imwrite(at, v)),
    "BMP": lambda f, v: saved(f / "m.bmp", Image.fromarray(v).save),
    "WebP": lambda f, v: saved(f / "m.webp", lambda at: Image.fromarray(v).save(at, lossless=True)),
}


def areas(instances: Instances) -> list[int]:
    return sorted(int(each.mask.sum()) for each in instances)


@pytest.mark.parametrize("name", MASKS)
def test_masks_of_one_value_are_split_and_told(tmp_path: Path, name: str) -> None:
    path = MASKS[name](tmp_path, MASK)
    found = read_labels(path, shape=SHAPE)
    assert areas(found) == sorted(int(mask.sum()) for mask in APART)
    assert len(found.notes) == 1
    assert len(read_labels(path, shape=SHAPE, pieces="keep")) == 1


SQUARE = [[9.5, 19.5], [19.5, 19.5], [19.5, 29.5], [9.5, 29.5]]


def coco(folder: Path, *segmentations: object) -> Path:
    image = {"id": 1, "width": SHAPE[1], "height": SHAPE[0], "file_name": "i.png"}
    annotations = [
        {"id": number, "image_id": 1, "category_id": 1, "segmentation": each, "iscrowd": 0}
        for number, each in enumerate(segmentations, start=1)
    ]
    return written(folder / "l.json", {"images": [image], "annotations": annotations})


def labelme(folder: Path, *rings: list[list[float]]) -> Path:
    shapes = [{"label": "rock", "points": ring, "shape_type": "polygon"} for ring in rings]
    size = {"imageHeight": SHAPE[0], "imageWidth": SHAPE[1]}
    return written(folder / "l.json", {"version": "5", "shapes": shapes, "imagePath": "i", **size})


def yolo(folder: Path, *rings: list[list[float]]) -> Path:
    lines = (" ".join(map(str, (np.array(ring) / SHAPE[::-1]).ravel())) for ring in rings)
    return written(folder / "i.txt", "".join(f"0 {line}\n" for line in lines))


def geojson(folder: Path, *rings: list[list[float]]) -> Path:
    features = [
        {
            "type": "Feature",
            "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]},
            "properties": {},
        }
        for ring in rings
    ]
    return written(folder / "l.geojson", {"type": "FeatureCollection", "features": features})


def roi_set(folder: Path, *rings: list[list[float]]) -> Path:
    regions = [
        roifile.ImagejRoi.frompoints(np.array(ring, np.float32), name=str(number))
        for number, ring in enumerate(rings, start=1)
    ]
    return saved(folder / "RoiSet.zip", lambda at: roifile.roiwrite(at, regions, mode="w"))


def results(folder: Path, *segmentations: object, **more: object) -> Path:
    keys = {"image_id": 1, "category_id": 1, "score": 0.9} | more
    return written(folder / "l.json", [{"segmentation": each, **keys} for each in segmentations])


def flat(ring: list[list[float]]) -> list[list[float]]:
    return [[value for point in ring for value in point]]


POLYGONS: dict[str, Callable[..., Path]] = {
    "COCO": lambda f, *rings: coco(f, *map(flat, rings)),
    "COCO results": lambda f, *rings: results(f, *map(flat, rings)),
    "LabelMe": labelme,
    "YOLO": yolo,
    "GeoJSON": geojson,
    "RoiSet": roi_set,
}


@pytest.mark.parametrize("name", POLYGONS)
@pytest.mark.parametrize("turned", [False, True])
def test_a_square_with_corners_at_half_pixels_counts_no_row_twice(
    tmp_path: Path, name: str, turned: bool
) -> None:
    ring = SQUARE[::-1] if turned else SQUARE
    (found,) = read_labels(POLYGONS[name](tmp_path, ring), shape=SHAPE)
    assert found.mask.shape == (10, 10)
    assert found.mask.all()
    packed = coco_mask.frPyObjects(flat(ring), *SHAPE)  # the rule that COCO's tools follow
    assert abs(int(coco_mask.area(packed)[0]) - 100) <= 10


OVERLAPPING = [disc(30, 30, 20), disc(30, 50, 20)]
BOXES = [[[5, 5], [45, 5], [45, 35], [5, 35]], [[25, 15], [65, 15], [65, 50], [25, 50]]]
SAM = {"predicted_iou": 0.9, "stability_score": 0.9, "bbox": [0, 0, 1, 1]}


def folder_of(suffix: str, folder: Path, *masks: np.ndarray) -> Path:
    place = folder / "masks"
    place.mkdir()
    for number, mask in enumerate(masks, start=1):
        if suffix == ".npy":
            np.save(place / f"rock_{number}.npy", mask)
        else:
            cv2.imwrite(str(place / f"rock_{number}{suffix}"), mask.astype(np.uint8) * 255)
    return place


STACKS: dict[str, Callable[..., Path]] = {
    "COCO, packed": lambda f, *masks: coco(f, *map(run_lengths, masks)),
    "COCO results": lambda f, *masks: results(f, *map(run_lengths, masks)),
    "SAM": lambda f, *masks: results(f, *map(run_lengths, masks), **SAM),
    "PNG folder": lambda f, *masks: folder_of(".png", f, *masks),
    "TIFF folder": lambda f, *masks: folder_of(".tif", f, *masks),
    "BMP folder": lambda f, *masks: folder_of(".bmp", f, *masks),
    "NPY folder": lambda f, *masks: folder_of(".npy", f, *masks),
    "NPY stack": lambda f, *masks: saved(f / "m.npy", lambda at: np.save(at, np.stack(masks))),
    "NPY stack of 255": lambda f, *masks: saved(
        f / "m.npy", lambda at: np.save(at, 255 * np.stack(masks).astype(np.uint8))
    ),
    "NPZ stack": lambda f, *masks: saved(f / "m.npz", lambda at: np.savez(at, masks=masks)),
    "TIFF pages": lambda f, *masks: saved(
        f / "m.tif",
        lambda at: tifffile.imwrite(
            at, np.stack(masks).astype(np.uint8) * 255, photometric="minisblack"
        ),
    ),
}


@pytest.mark.parametrize("name", STACKS)
def test_masks_that_overlap_keep_their_pixels(tmp_path: Path, name: str) -> None:
    found = read_labels(STACKS[name](tmp_path, *OVERLAPPING), shape=SHAPE)
    assert areas(found) == sorted(int(mask.sum()) for mask in OVERLAPPING)


@pytest.mark.parametrize("name", POLYGONS)
def test_polygons_that_overlap_keep_their_pixels(tmp_path: Path, name: str) -> None:
    found = read_labels(POLYGONS[name](tmp_path, *BOXES), shape=SHAPE)
    assert areas(found) == [40 * 30, 40 * 35]


@pytest.mark.parametrize("name", ["COCO", "COCO results", "LabelMe", "GeoJSON"])
def test_a_byte_order_mark_is_passed_over(tmp_path: Path, name: str) -> None:
    path = POLYGONS[name](tmp_path, *BOXES)
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
    assert len(read_labels(path, shape=SHAPE)) == len(BOXES)


@pytest.mark.parametrize("number", [0, 2**31, 2**40])
def test_ids_are_kept_in_every_list(tmp_path: Path, number: int) -> None:
    path = coco(tmp_path, flat(SQUARE))
    content = json.loads(path.read_text())
    content["annotations"][0]["id"] = number
    assert [each.id for each in read_labels(written(path, content), shape=SHAPE)] == [number]
    path = geojson(tmp_path, SQUARE)
    content = json.loads(path.read_text())
    content["features"][0]["id"] = number
    assert [each.id for each in read_labels(written(path, content), shape=SHAPE)] == [number]


SMOOTHED = cv2.GaussianBlur(MASK, (0, 0), 1.5)
LOSSY = cv2.imdecode(cv2.imencode(".jpg", MASK, [cv2.IMWRITE_JPEG_QUALITY, 60])[1], -1)
PICTURES = {
    "a blurred mask": SMOOTHED,
    "a mask that was scaled": cv2.resize(MASK[::2, ::2], SHAPE[::-1]),
    "a mask that was a JPEG": LOSSY,
}


@pytest.mark.parametrize("picture", PICTURES)
@pytest.mark.parametrize("name", ["PNG", "TIFF", "NPY", "PGM", "BMP", "WebP", "NPZ"])
def test_grey_levels_are_no_ids(tmp_path: Path, name: str, picture: str) -> None:
    path = MASKS[name](tmp_path, PICTURES[picture])
    with pytest.raises(InputError, match=r"expected a number for each rock, found \d+ numbers"):
        read_labels(path, shape=SHAPE)


@pytest.mark.parametrize("picture", PICTURES)
def test_nor_in_an_array(picture: str) -> None:
    with pytest.raises(InputError, match="labels: expected a number for each rock"):
        instances_of(PICTURES[picture])


def test_rocks_that_touch_are_no_grey_levels() -> None:
    """Tiles without a pixel of ground, and single pixels apart."""
    tiles = 1 + (ROWS // 3) * 30 + COLS // 3
    specks = np.where((ROWS % 2 == 0) & (COLS % 2 == 0), 1 + ROWS * SHAPE[1] + COLS, 0)
    for labels in (tiles, specks):
        assert len(instances_of(labels)) == len(np.unique(labels[labels > 0]))
