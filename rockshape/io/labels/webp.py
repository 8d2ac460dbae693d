"""Lossless WebP label images."""

from typing import TYPE_CHECKING

from rockshape.errors import InputError
from rockshape.io.decoding.label_image import instances_of
from rockshape.io.decoding.pillow import read_numbers
from rockshape.io.format import ImageInfo, LabelFormat
from rockshape.io.images.webp import is_webp

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances

LOSSLESS = b"VP8L"


def read_webp(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of a lossless WebP whose channels are equal.

    Raises: InputError for lossy compression, which changes numbers, and for colours.
    """
    if LOSSLESS not in _chunks(file.data):
        raise InputError(
            f"{file.path}: expected labels without loss, found lossy WebP; save them as PNG"
        )
    return instances_of(file, read_numbers(file, "WEBP"), info)


def _chunks(data: bytes) -> set[bytes]:
    """Names of the RIFF chunks of a file."""
    names, place = set(), 12
    while place + 8 <= len(data):
        names.add(data[place : place + 4])
        size = int.from_bytes(data[place + 4 : place + 8], "little")
        place += 8 + size + size % 2
    return names


FORMAT = LabelFormat(
    name="WebP",
    suffixes=(".webp",),
    summary="lossless, grey levels as PNG has them, 8 bits",
    tested_with="Pillow",
    sniff=is_webp,
    read=read_webp,
)
