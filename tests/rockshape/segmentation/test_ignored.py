"""Pixels that are said to be no rock."""

import cv2
import numpy as np
import pytest

import rockshape
from rockshape.errors import InputError
from rockshape.rock.instances import Instances
from rockshape.segmentation import Segmentation
from rockshape.segmentation.finders import Finder
from rockshape.segmentation.result import FoundRock

LABELS = np.zeros((60, 90), dtype=np.int32)
LABELS[10:30, 10:30] = 1
LABELS[10:30, 50:80] = 2
LABELS[40:55, 10:40] = 3


def _find(observation: rockshape.Observation) -> Segmentation:
    whole = tuple(slice(0, size) for size in observation.image.shape)
    found = tuple(FoundRock(number, "image") for number in (1, 2, 3))
    return Segmentation(Instances.from_labels(LABELS), None, whole, found)


FINDER = Finder("drawn", "three squares", _find)
IMAGE = np.where(LABELS > 0, 200, 60).astype(np.uint8)


def test_a_rock_half_on_ignored_pixels_goes_and_one_less_than_half_loses_them():
    ignored = np.zeros(LABELS.shape, dtype=bool)
    ignored[:, :20] = True  # half of rock 1, a third of rock 3
    found = rockshape.measure(IMAGE, find=FINDER, ignore=ignored)
    assert [rock.number for rock in found] == [2, 3]
    labels = found.labels
    assert not labels[ignored].any()
    assert np.array_equal(labels == 3, (LABELS == 3) & ~ignored)
    assert np.array_equal(labels == 2, LABELS == 2)


def test_numbers_do_for_a_mask_and_nothing_ignored_changes_nothing():
    nothing = np.zeros(LABELS.shape, dtype=np.uint8)
    assert len(rockshape.measure(IMAGE, find=FINDER, ignore=nothing)) == 3
    assert len(rockshape.measure(IMAGE, find=FINDER, ignore=nothing + 255)) == 0


def test_another_shape_and_given_rocks_are_refused():
    with pytest.raises(InputError, match=r"ignore: expected \(60, 90\).*found \(60, 89\)"):
        rockshape.measure(IMAGE, find=FINDER, ignore=np.zeros((60, 89)))
    with pytest.raises(InputError, match=r"ignore: expected rocks that are to be found"):
        rockshape.measure(IMAGE, labels=LABELS, ignore=np.zeros(LABELS.shape))


def test_the_mask_is_read_from_a_file(tmp_path):
    cv2.imwrite(str(tmp_path / "image.png"), IMAGE)
    mask = np.zeros(LABELS.shape, dtype=np.uint8)
    mask[:35] = 255
    cv2.imwrite(str(tmp_path / "mask.png"), mask)
    observation = rockshape.read(tmp_path / "image.png", ignore=tmp_path / "mask.png")
    assert np.array_equal(observation.ignored, mask > 0)
    assert [rock.number for rock in rockshape.measure(observation, find=FINDER)] == [3]
    with pytest.raises(InputError, match=r"none\.png"):
        rockshape.read(tmp_path / "image.png", ignore=tmp_path / "none.png")
