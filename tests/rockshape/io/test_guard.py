"""The guard around readers: what is declared is checked before it is decoded, failures are a line.

The declared sizes lie: none of these files holds what its header says.
"""

import logging
import os
import struct
import warnings
import zipfile
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from rockshape.cli import main
from rockshape.errors import InputError, one_line
from rockshape.io import (
    ImageFormat,
    read_image,
    read_labels,
    read_range,
    register_format,
)
from rockshape.io.registry import REGISTRIES

HUGE = 10**6


@pytest.fixture(autouse=True)
def nothing_stays_registered() -> Iterator[None]:
    yield
    for registry in REGISTRIES:
        registry.registered.clear()


def png(rows: int, cols: int) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    header = struct.pack(">IIBBBBB", cols, rows, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", b"") + chunk(b"IEND", b"")


def tiff(rows: int, cols: int, following: int = 0, big: bool = False) -> bytes:
    """TIFF of 8-bit grey without data; following: where the next directory is."""
    entries = [(256, 4, cols), (257, 4, rows), (258, 3, 8), (259, 3, 1), (262, 3, 1)]
    entries += [(273, 4, 8), (278, 4, rows), (279, 4, 100)]
    if big:
        packed = b"".join(struct.pack("<HHQQ", *entry[:2], 1, entry[2]) for entry in entries)
        return (b"II+\0" + struct.pack("<HHQQ", 8, 0, 16, len(entries)) + packed) + struct.pack(
            "<Q", following
        )
    packed = b"".join(struct.pack("<HHII", *entry[:2], 1, entry[2]) for entry in entries)
    return b"II*\0" + struct.pack("<IH", 8, len(entries)) + packed + struct.pack("<I", following)


def npy(shape: tuple[int, ...], kind: str = "<f8") -> bytes:
    text = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}}}\n".encode()
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(text)) + text


@pytest.mark.parametrize(
    ("name", "data", "says"),
    [
        ("a.png", png(HUGE, HUGE), r"at most 134217728 pixels \(--max-pixels\)"),
        ("a.tif", tiff(HUGE, HUGE), r"at most 134217728 pixels \(--max-pixels\)"),
        ("a.tif", tiff(HUGE, HUGE, big=True), r"at most 134217728 pixels \(--max-pixels\)"),
        ("a.tif", tiff(9, 9, following=8), "directory at byte 8 is named twice"),
        ("a.tif", tiff(9, 9, following=16, big=True), "directory at byte 16 is named twice"),
        ("a.tif", tiff(9, 9, following=9999), "cut short within its directories"),
        ("a.tif", tiff(9, 9, following=24), "TIFF"),
    ],
)
def test_images_are_bounded(tmp_path: Path, name: str, data: bytes, says: str) -> None:
    path = tmp_path / name
    path.write_bytes(data)
    with pytest.raises(InputError, match=rf"{name}: expected .*{says}"):
        read_image(path)


@pytest.mark.parametrize(
    ("shape", "says"),
    [
        ((HUGE, HUGE), "at most 134217728 pixels"),
        ((9000, 9000, 30), "at most 1073741824 bytes"),
        ((9000, 9000), r"expected \(20, 30\) as the image has, found \(9000, 9000\)"),
        ((20, 30), r"found 0 of 4800 bytes of an array \(20, 30\) of float64"),
        ((-1, 600), "expected range"),
    ],
)
@pytest.mark.parametrize("packed", [False, True])
def test_arrays_are_bounded(
    tmp_path: Path, shape: tuple[int, ...], says: str, packed: bool
) -> None:
    path = tmp_path / ("range.npz" if packed else "range.npy")
    if packed:
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("xyz.npy", npy(shape))
    else:
        path.write_bytes(npy(shape))
    with pytest.raises(InputError, match=rf"range\.np[yz]: .*{says}"):
        read_range(path, shape=(20, 30), camera=None)


def test_a_pipe_is_no_file_to_wait_for(tmp_path: Path) -> None:
    path = tmp_path / "pipe.png"
    os.mkfifo(path)
    with pytest.raises(InputError, match="found no regular file"):
        read_image(path)


def failing(raised: Callable[[], BaseException]) -> None:
    def read(_: object) -> np.ndarray:
        raise raised()

    register_format(ImageFormat(name="own", suffixes=(".own",), summary="", read=read))


@pytest.mark.parametrize(
    ("raised", "says"),
    [
        (lambda: SystemExit(0), "found 0"),
        (MemoryError, "more than the memory holds"),
        (RecursionError, "nesting that is too deep"),
        (lambda: ValueError("a\n\x1b[31mb\0\u202ec"), r"found a \[31mb c$"),
        (ZeroDivisionError, "found ZeroDivisionError"),
    ],
)
def test_whatever_a_reader_raises_becomes_a_printable_line(
    tmp_path: Path, raised: Callable[[], BaseException], says: str
) -> None:
    failing(raised)
    path = tmp_path / "image.own"
    path.write_text("x")
    with pytest.raises(InputError, match=rf"expected an image \(own\), .*{says}"):
        read_image(path)


def test_an_interrupt_is_no_failure_of_the_file(tmp_path: Path) -> None:
    failing(KeyboardInterrupt)
    path = tmp_path / "image.own"
    path.write_text("x")
    with pytest.raises(KeyboardInterrupt):
        read_image(path)


def test_the_command_prints_one_short_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "new\nline\x1b[2J.png"
    path.write_text("no image")
    assert main(["measure", str(path)]) == 2
    printed = capsys.readouterr().err
    assert printed.count("\n") == 1
    assert "\x1b" not in printed
    assert main(["measure", "/" + "x" * 2000 + ".png"]) == 2
    assert len(capsys.readouterr().err) <= 501


def test_what_is_too_long_loses_its_middle() -> None:
    line = one_line("begin " + "x" * 900 + " end")
    assert len(line) == 500
    assert line.startswith("begin x")
    assert line.endswith("x end")
    assert "..." in line


def test_other_libraries_keep_quiet_and_get_their_voice_back(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    import cv2

    log = getattr(cv2.utils, "logging", cv2)
    before = log.getLogLevel()

    def read(_: object) -> np.ndarray:
        logging.getLogger("tifffile").error("loud")
        logging.getLogger("PIL.TiffImagePlugin").error("loud")
        warnings.warn("loud", stacklevel=1)
        cv2.imread(str(tmp_path / "none.png"))
        return np.zeros((2, 2), dtype=np.uint8)

    register_format(ImageFormat(name="own", suffixes=(".own",), summary="", read=read))
    path = tmp_path / "image.own"
    path.write_text("x")
    read_image(path)
    assert capfd.readouterr().err == ""
    assert log.getLogLevel() == before
    assert logging.getLogger("tifffile").level == logging.NOTSET


def test_a_label_bomb_is_told_from_the_image(tmp_path: Path) -> None:
    path = tmp_path / "labels.png"
    path.write_bytes(png(9000, 9000))
    with pytest.raises(InputError, match=r"expected \(20, 30\) as the image has, found"):
        read_labels(path, shape=(20, 30))
