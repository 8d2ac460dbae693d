"""Instances: label images there and back, and masks that overlap."""

import numpy as np
import pytest

from rockshape.errors import InputError
from rockshape.rock.instances import Instance, Instances


def test_a_label_image_there_and_back_keeps_the_ids() -> None:
    rng = np.random.default_rng(3)
    labels = rng.choice([0, 0, 2, 7, 300], size=(31, 43)).astype(np.int32)
    instances = Instances.from_labels(labels)
    assert [item.id for item in instances] == [2, 7, 300]
    assert len(instances) == 3
    np.testing.assert_array_equal(instances.to_labels(), labels)
    for item in instances:
        assert item.mask.sum() == (labels == item.id).sum()
        assert item.mask.any(axis=0)[[0, -1]].all()
        assert item.mask.any(axis=1)[[0, -1]].all()


def test_no_rocks_are_no_instances() -> None:
    empty = Instances.from_labels(np.zeros((4, 5), dtype=np.uint8))
    assert len(empty) == 0
    assert empty.to_labels().shape == (4, 5)


def test_overlapping_rocks_keep_their_own_pixels_and_the_later_covers() -> None:
    mask = np.ones((3, 3), dtype=bool)
    instances = Instances(
        (6, 6), (Instance(4, np.s_[0:3, 0:3], mask), Instance(9, np.s_[2:5, 2:5], mask))
    )
    labels = instances.to_labels()
    assert (labels == 4).sum() == 8
    assert (labels == 9).sum() == 9
    assert all(item.mask.sum() == 9 for item in instances)


@pytest.mark.parametrize(
    ("ids", "window", "says"),
    [
        ((1, 1), np.s_[0:3, 0:3], "each id once"),
        ((1, 2), np.s_[0:3, 0:4], "fills its window"),
        ((1, 2), np.s_[4:7, 0:3], "fills its window"),
    ],
    ids=["twice", "wider", "beyond the image"],
)
def test_what_cannot_be_instances_is_refused(ids: tuple, window: tuple, says: str) -> None:
    mask = np.ones((3, 3), dtype=bool)
    with pytest.raises(InputError, match=says):
        Instances((6, 6), tuple(Instance(number, window, mask) for number in ids))
