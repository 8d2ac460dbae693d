"""Refusal of files of no known format: the file, what is known and what was found, in a line."""

import pickle
from pathlib import Path

import pytest

from rockshape.errors import InputError
from rockshape.io import known_formats, read_camera, read_image, read_labels, read_range

CONTENTS = {
    b"": "an empty file",
    b"some words": "text",
    '{"fx": "é"}'.encode(): "JSON",
    b"[section]\nkey = 1": "text",
    pickle.dumps([1]): "pickled objects, which are never loaded",
    b"GIF89a\0\0": "GIF",
    b"\0\1\2\3\xff": "unknown data that begin with 00 01 02 03",
    b"ply\nformat ascii 1.0\n": "PLY (range)",
    b"\xff\xd8\xff\xe0": "JPEG (image)",
    b"II*\0": "TIFF (image or labels or range)",
    b"\x93NUMPY": "NPY (labels or range)",
}


@pytest.mark.parametrize(("data", "found"), CONTENTS.items(), ids=CONTENTS.values())
def test_a_refusal_names_the_file_what_is_known_and_what_was_found(
    tmp_path: Path, data: bytes, found: str
) -> None:
    path = tmp_path / "some.dat"
    path.write_bytes(data)
    suffix = "" if not data else ", and the suffix .dat"
    readers = {
        "an image": ("image", lambda: read_image(path)),
        "labels": ("labels", lambda: read_labels(path, shape=(2, 2))),
        "range": ("range", lambda: read_range(path, shape=(2, 2), camera=None)),
        "a camera": ("camera", lambda: read_camera(path)),
    }
    for noun, (kind, read) in readers.items():
        names = [each.name for each in known_formats(kind) if each.readable]
        if found.partition(" ")[0] in names:
            continue  # the content is of this kind
        with pytest.raises(InputError) as refused:
            read()
        expected = f"{noun} ({', '.join(dict.fromkeys(names))})"
        told = f"{found}{suffix}"
        if kind == "labels" and found.startswith("JPEG"):
            told = "JPEG, whose lossy compression changes numbers"
        assert str(refused.value) == f"{path}: expected {expected}, found {told}"


def test_a_file_that_is_not_there_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "image"
    with pytest.raises(InputError, match=r"image: expected an image .*found no such file"):
        read_image(path)
    with pytest.raises(InputError, match="found a directory"):
        read_image(tmp_path)


def test_text_cut_within_a_character_is_text(tmp_path: Path) -> None:
    path = tmp_path / "notes"
    path.write_text("é" * 40000)  # the head ends between the two bytes of one
    with pytest.raises(InputError, match="found text, and no suffix"):
        read_image(path)
    path.write_text("x" + "é" * 40000)
    with pytest.raises(InputError, match="found text, and no suffix"):
        read_image(path)
