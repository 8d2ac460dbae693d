"""Label images: the ids that they hold, and what is no label image."""

from pathlib import Path

import numpy as np
import pytest
import tifffile

from rockshape.errors import InputError
from rockshape.io import read_labels, write_labels
from rockshape.rock.instances import Instance, Instances


@pytest.mark.parametrize("kind", ["uint8", "uint16", "int32"])
def test_labels_keep_their_values(tmp_path: Path, kind: str) -> None:
    labels = np.array([[0, 3], [200, 0]], dtype=kind)
    path = tmp_path / "labels.tif"
    tifffile.imwrite(path, labels)
    assert np.array_equal(read_labels(path, shape=(2, 2)).to_labels(), labels)


@pytest.mark.parametrize("kind", ["uint8", "int64", ">i4"])
def test_labels_are_read_from_an_array(tmp_path: Path, kind: str) -> None:
    labels = np.array([[0, 3], [70, 0]], dtype=kind)
    np.save(tmp_path / "labels.npy", labels)
    found = read_labels(tmp_path / "labels.npy", shape=(2, 2)).to_labels()
    assert np.array_equal(found, labels)


@pytest.mark.parametrize(
    ("array", "says"),
    [
        (np.full((2, 2), 0.5), "whole numbers, found fractions of float64"),
        (np.full((2, 2), np.nan), r"0 the ground, found 4 pixels that are not a number \(NaN\)"),
        (np.zeros((2, 3, 3), int), r"mask 1: expected \(2, 2\) as the image has, found \(3, 3\)"),
        (np.zeros((1, 2, 2, 2), int), r"found \(1, 2, 2, 2\)"),
        (np.array([["a", "b"]]), "whole numbers, found <U1"),
        (np.zeros((3, 2), int), r"expected \(2, 2\) as the image has, found \(3, 2\)"),
        (np.array([[None, {}]]), "pickled objects"),
        (np.full((2, 2), 2**63, dtype=np.uint64), "found 9223372036854775808"),
    ],
)
def test_arrays_that_are_no_labels_are_refused(
    tmp_path: Path, array: np.ndarray, says: str
) -> None:
    path = tmp_path / "labels.npy"
    np.save(path, array)
    with pytest.raises(InputError, match=rf"labels\.npy: .*{says}"):
        read_labels(path, shape=(2, 2))


def test_damaged_arrays_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "labels.npy"
    np.save(path, np.ones((2, 2), int))
    cut = path.read_bytes()[:40]
    for data, says in ((b"", "empty"), (b"no array", "found text"), (cut, r"labels \(NPY\)")):
        path.write_bytes(data)
        with pytest.raises(InputError, match=rf"labels\.npy: expected labels .*{says}|{says}"):
            read_labels(path, shape=(2, 2))
    with path.open("wb") as file:
        np.savez(file, one=np.zeros((2, 2), int), two=np.zeros((2, 2), int))
    with pytest.raises(InputError, match=r"expected the key labels or .*, found one, two"):
        read_labels(path, shape=(2, 2))


def test_negative_labels_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "labels.tif"
    tifffile.imwrite(path, np.array([[0, -3]], dtype=np.int32))
    with pytest.raises(InputError, match="found -3 to 0"):
        read_labels(path, shape=(1, 2))


BOX = np.ones((2, 2), dtype=bool)


def at(number: int, row: int, col: int) -> Instance:
    return Instance(number, (slice(row, row + 2), slice(col, col + 2)), BOX)


@pytest.mark.parametrize("ending", ["png", "tif", "tiff"])
def test_written_labels_read_back(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"labels.{ending}"
    labels = np.zeros((4, 5), dtype=np.int32)
    labels[:2, :2], labels[2:, 3:] = 7, 65535
    write_labels(path, Instances((4, 5), (at(7, 0, 0), at(65535, 2, 3))))
    np.testing.assert_array_equal(read_labels(path, shape=(4, 5)).to_labels(), labels)


@pytest.mark.parametrize(
    ("items", "says"),
    [
        ((at(3, 0, 0), at(9, 1, 1)), "do not overlap in a label image, found 3 and 9 sharing 1 "),
        ((at(0, 0, 0),), "ids from 1 to 65535 in a label image, found 0"),
        ((at(70000, 0, 0),), "found 70000"),
    ],
)
def test_a_label_image_cannot_hold_everything(
    tmp_path: Path, items: tuple[Instance, ...], says: str
) -> None:
    path = tmp_path / "labels.png"
    with pytest.raises(InputError, match=rf"labels\.png: .*{says}"):
        write_labels(path, Instances((4, 5), items))
    assert not path.exists()
