"""Format registry: the choice of a format, the refusals, and formats from outside the package."""

import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from rockshape.errors import InputError
from rockshape.io import (
    ImageFormat,
    RangeFormat,
    RangeRaster,
    TableFormat,
    known_formats,
    magic,
    read_image,
    read_range,
    register_format,
    write_image,
    write_table,
)
from rockshape.io.registry import IMAGES, RANGES, REGISTRIES
from tests.plugins.ascii_range import FORMAT as XYZ_TEXT

PLUGINS = Path(__file__).parents[2] / "plugins"
POINTS = np.arange(1, 19, dtype=np.float64).reshape(2, 3, 3)


@pytest.fixture(autouse=True)
def nothing_stays_registered() -> Iterator[None]:
    yield
    for registry in REGISTRIES:
        registry.registered.clear()


def xyz_file(folder: Path) -> Path:
    path = folder / "points.xyz"
    np.savetxt(path, POINTS.reshape(-1, 3))
    return path


def test_a_range_format_from_outside_is_read_once_registered(tmp_path: Path) -> None:
    path = xyz_file(tmp_path)
    with pytest.raises(InputError, match=r"points\.xyz: expected range .*found text"):
        read_range(path, shape=(2, 3), camera=None)
    register_format(XYZ_TEXT)
    np.testing.assert_array_equal(read_range(path, shape=(2, 3), camera=None), POINTS)
    # the registry checks what a reader from outside returns, and that it ends in one line
    with pytest.raises(InputError, match=r"points\.xyz: expected range \(XYZ text\), found cannot"):
        read_range(path, shape=(4, 4), camera=None)


def test_an_entry_point_adds_a_format_to_the_command(tmp_path: Path) -> None:
    info = tmp_path / "site" / "ascii_range-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: ascii-range\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[rockshape.formats]\nxyz = ascii_range:FORMAT\n")
    image = tmp_path / "image.png"
    cv2.imwrite(str(image), np.zeros((2, 3), dtype=np.uint8))
    environment = os.environ | {"PYTHONPATH": f"{tmp_path / 'site'}{os.pathsep}{PLUGINS}"}
    command = [sys.executable, "-m", "rockshape.cli"]

    def run(*arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [*command, *arguments], env=environment, capture_output=True, text=True, check=False
        )

    listed = run("formats", "range")
    assert listed.returncode == 0, listed.stderr
    rows = [" ".join(line.split()) for line in listed.stdout.split("\n")]
    assert "XYZ text .xyz read a line a pixel: x, y, z, m" in rows
    measured = run("measure", str(image), "--range", str(xyz_file(tmp_path)))
    assert measured.returncode == 0, measured.stderr
    (info / "entry_points.txt").write_text("[rockshape.formats]\nxyz = ascii_range:np\n")
    broken = run("measure", str(image))
    assert broken.returncode == 2
    assert broken.stderr == (
        "rockshape: entry point xyz = ascii_range:np of rockshape.formats: "
        "expected a format, found module\n"
    )


@pytest.mark.parametrize("name", ["jpg", "png", "tif", "dat", ""])
def test_the_content_decides_where_the_name_misleads(tmp_path: Path, name: str) -> None:
    path = tmp_path / f"image.{name}".rstrip(".")
    pixels = np.array([[0, 255, 51]], dtype=np.uint8)
    path.write_bytes(cv2.imencode(".png", pixels)[1].tobytes())
    np.testing.assert_allclose(read_image(path), [[0, 1, 0.2]], atol=1e-6)


def marked(name: str, value: float, **options: object) -> RangeFormat:
    """A format whose every file holds the value."""

    def read(_: object, info: object) -> RangeRaster:
        return RangeRaster(np.full((*info.shape, 3), float(value)))

    return RangeFormat(name=name, suffixes=(".npy",), summary="a number", read=read, **options)


@pytest.mark.parametrize(
    ("added", "value"),
    [
        (marked("special", 7, sniff=magic(b"\x93NUMPY\x01")), 7),  # before the package's own
        (marked("other", 7, sniff=magic(b"other")), 1),  # not its content
        (marked("by name", 7), 1),  # the package's own recognises the content
    ],
    ids=["special", "other content", "no sniffing"],
)
def test_which_of_several_formats_reads(tmp_path: Path, added: RangeFormat, value: float) -> None:
    path = tmp_path / "range.npy"
    np.save(path, np.ones((2, 2, 3)))
    register_format(added)
    assert (read_range(path, shape=(2, 2), camera=None) == value).all()


def test_a_suffix_without_sniffing_is_chosen_for_unknown_content(tmp_path: Path) -> None:
    path = tmp_path / "range.npy"
    path.write_text("whatever")
    register_format(marked("by name", 7))
    assert (read_range(path, shape=(2, 2), camera=None) == 7).all()


def test_a_name_can_be_registered_anew_but_not_taken_from_the_package() -> None:
    register_format(XYZ_TEXT)
    register_format(replace(XYZ_TEXT, summary="edited in a notebook"))
    assert [each.summary for each in known_formats("range") if each.name == "XYZ text"] == [
        "edited in a notebook"
    ]
    with pytest.raises(InputError, match="expected a new name for range, found 'NPY'"):
        register_format(replace(XYZ_TEXT, name="NPY"))
    with pytest.raises(InputError, match=r"expected one of ImageFormat, .*found dict"):
        register_format({"name": "XYZ"})


def test_a_writer_from_outside_is_chosen_by_the_suffix(tmp_path: Path) -> None:
    register_format(
        ImageFormat(
            name="Sun raster",
            suffixes=(".ras",),
            summary="grey",
            write=lambda pixels: cv2.imencode(".ras", pixels)[1].tobytes(),
        )
    )
    path = tmp_path / "image.ras"
    write_image(path, np.full((2, 3), 9, dtype=np.uint8))
    assert path.read_bytes().startswith(b"\x59\xa6\x6a\x95")
    with pytest.raises(InputError, match=r"expected an image .*, found unknown data"):
        read_image(path)  # it is only written
    register_format(
        TableFormat(name="broken", suffixes=(".x",), summary="", write=lambda frame: frame[0])
    )
    with pytest.raises(InputError, match=r"table\.x: 0"):
        write_table(tmp_path / "table.x", {})


def test_whatever_a_reader_raises_is_one_line(tmp_path: Path) -> None:
    def read(_: object) -> np.ndarray:
        raise MemoryError

    register_format(ImageFormat(name="huge", suffixes=(".huge",), summary="", read=read))
    path = tmp_path / "image.huge"
    path.write_text("x")
    with pytest.raises(
        InputError, match=r"image\.huge: expected an image \(huge\), found more than the"
    ):
        read_image(path)


def test_the_packages_own_formats_are_told_apart() -> None:
    for registry in REGISTRIES:
        names = [each.name for each in registry.own]
        assert len(set(names)) == len(names)
        for each in registry.own:
            assert each.kind == registry.kind
            assert each.readable or each.writable
            assert each.suffixes or each.folder
            # a reader is tested on a file from a writer that is not ours, or on a specification
            assert each.tested_with or not each.readable
            assert all(suffix == suffix.lower() and suffix[0] == "." for suffix in each.suffixes)
    assert {each.name for each in known_formats()} >= {
        each.name for each in (*IMAGES.own, *RANGES.own)
    }
