"""Rocks outlined by hand in five lander frames: what the examples' table says of them is so."""

import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

import rockshape
from rockshape.rock.instances import Instances
from tests.paths import EXAMPLES, MARS_IMAGE, MARS_RANGE

OUTLINES = EXAMPLES / "mars" / "outlines"
HALVED = ("i924795", "i925510", "i925814", "i944537")
FRAMES = (*HALVED, "i944014r")
SHAPE = (248, 256)


def half(frame: str) -> Path:
    return EXAMPLES / "photos" / f"{frame}_half.png"


def outlined(frame: str, folder: Path, name: str = "") -> Instances:
    """Rocks of a frame at 248×256 pixels: its own, or its texture's enlarged twice."""
    image = MARS_IMAGE
    if frame in HALVED:
        image = folder / f"{frame}.png"
        texture = cv2.imread(str(half(frame)))
        cv2.imwrite(str(image), texture.repeat(2, axis=0).repeat(2, axis=1))
    labels = OUTLINES / f"{name or frame}.json"
    instances = rockshape.read(image, labels=labels).instances
    assert instances is not None
    return instances


def annotations(name: str) -> list[dict[str, Any]]:
    """What a file says of its first image, which is the frame at 248×256 pixels."""
    content = json.loads((OUTLINES / f"{name}.json").read_text())
    assert (content["images"][0]["height"], content["images"][0]["width"]) == SHAPE
    return [each for each in content["annotations"] if each["image_id"] == 1]


def corners(annotation: dict[str, Any]) -> NDArray[np.float64]:
    (flat,) = annotation["segmentation"]
    return np.reshape(flat, (-1, 2)).astype(np.float64)


def whole(instances: Instances) -> dict[int, NDArray[np.bool_]]:
    masks = {each.id: np.zeros(instances.shape, dtype=bool) for each in instances}
    for each in instances:
        masks[each.id][each.window] = each.mask
    return masks


@pytest.mark.parametrize("frame", FRAMES)
def test_outlines_are_read_as_they_are_drawn(frame: str, tmp_path: Path) -> None:
    masks = whole(outlined(frame, tmp_path))
    told = {each["id"]: each for each in annotations(frame) if not each["iscrowd"]}
    assert set(masks) == set(told)
    for number, mask in masks.items():
        outline = corners(told[number])
        assert outline.min() >= 0
        assert (outline.max(axis=0) <= SHAPE[::-1]).all()
        x, y = outline.T  # the shoelace formula; pixels are counted to half the outline's length
        area = abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2
        length = np.hypot(*(np.roll(outline, -1, axis=0) - outline).T).sum()
        assert mask.sum() == told[number]["area"] > 30
        assert mask.sum() == pytest.approx(area, abs=length / 4)
        on_border = (outline <= 0).any() or (outline >= SHAPE[::-1]).any()
        assert told[number]["cut_by_frame"] == on_border
    count = np.sum(list(masks.values()), axis=0)
    assert (count > 1).sum() < 0.02 * (count > 0).sum()  # neighbours share an edge, no more


def test_there_are_as_many_as_the_table_says(tmp_path: Path) -> None:
    page = (EXAMPLES / "README.md").read_text()
    total = 0
    for frame in FRAMES:
        rocks = [each for each in annotations(frame) if not each["iscrowd"]]
        assert len(outlined(frame, tmp_path)) == len(rocks) >= 9
        wide = sum(np.ptp(corners(each)[:, 0]) >= 12 for each in rocks)
        cut = sum(each["cut_by_frame"] for each in rocks)
        regions = len(annotations(frame)) - len(rocks)
        assert f"| {frame} | {len(rocks)} | {wide} | {cut} | {regions} |" in page
        total += len(rocks)
    assert total >= 60
    assert f"{total} rocks" in page


@pytest.mark.parametrize("frame", HALVED)
def test_textures_have_the_same_rocks_and_their_range(frame: str, tmp_path: Path) -> None:
    full = whole(outlined(frame, tmp_path))
    points = EXAMPLES / "mars" / f"{frame}_half_xyz.npz"
    read = rockshape.read(half(frame), labels=OUTLINES / f"{frame}.json", range=points)
    assert read.instances is not None
    assert read.points_m is not None
    assert read.points_m.shape[:2] == read.image.shape[:2] == (124, 128)
    masks = whole(read.instances)
    assert {number - 1000 for number in masks} == set(full)
    for number, mask in masks.items():
        same = full[number - 1000]
        enlarged = mask.repeat(2, axis=0).repeat(2, axis=1)
        edge = cv2.morphologyEx(same.astype(np.uint8), cv2.MORPH_GRADIENT, np.ones((5, 5)))
        assert not ((enlarged ^ same) & (edge == 0)).any()  # they differ at the edge alone


def test_two_outlinings_differ_by_as_much_as_is_said(tmp_path: Path) -> None:
    first = whole(outlined("i944014r", tmp_path))
    again = whole(outlined("i944014r", tmp_path, "i944014r_again"))
    overlap = [(first[n] & mask).sum() / (first[n] | mask).sum() for n, mask in again.items()]
    ours = {each["id"]: corners(each) for each in annotations("i944014r")}
    distances = np.concatenate(
        [
            between(*pair)
            for each in annotations("i944014r_again")
            for pair in ((ours[each["id"]], corners(each)), (corners(each), ours[each["id"]]))
        ]
    )
    page = " ".join((EXAMPLES / "README.md").read_text().split())
    median, far = np.percentile(distances, [50, 95])
    assert f"median IoU {np.median(overlap):.2f} (least {min(overlap):.2f})" in page
    assert f"median distance {median:.2f} px (95 % within {far:.1f} px)" in page


def between(first: NDArray[np.float64], second: NDArray[np.float64]) -> NDArray[np.float64]:
    """Distances from another outline, px, every quarter pixel along one but on the frame."""
    closed = np.vstack([first, first[:1]])
    along = np.concatenate([[0], np.hypot(*np.diff(closed, axis=0).T).cumsum()])
    at = np.arange(0, along[-1], 0.25)
    points = np.column_stack([np.interp(at, along, closed[:, axis]) for axis in (0, 1)])
    inside = points[(points[:, 0] > 0) & (points[:, 0] < SHAPE[1])]
    polygon = second.astype(np.float32).reshape(-1, 1, 2)
    return np.abs([cv2.pointPolygonTest(polygon, tuple(map(float, p)), True) for p in inside])


def test_the_frame_with_range_is_measured_by_the_outlines() -> None:
    observation = rockshape.read(MARS_IMAGE, range=MARS_RANGE, labels=OUTLINES / "i944014r.json")
    assert len(rockshape.measure(observation)) == 9
