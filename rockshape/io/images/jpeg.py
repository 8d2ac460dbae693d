"""JPEG images."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.io.decoding.pillow import read_picture
from rockshape.io.decoding.raster import encode_raster
from rockshape.io.format import ImageFormat, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.io.format import ImageContent

JPEG_MAGIC = b"\xff\xd8\xff"


def decode_jpeg(file: "InputFile") -> "ImageContent":
    """ImageContent, turned by its EXIF orientation."""
    return read_picture(file, "JPEG", "MPO")


def encode_jpeg(pixels: NDArray[np.uint8] | NDArray[np.uint16]) -> bytes:
    """JPEG of 8-bit pixels. Raises: InputError for 16 bits."""
    if pixels.dtype != np.uint8:
        raise InputError(f"expected 8 bits a channel for JPEG, found {pixels.dtype}")
    return encode_raster(".jpg", pixels)


FORMAT = ImageFormat(
    name="JPEG",
    suffixes=(".jpg", ".jpeg"),
    summary="grey or colour, 8 bits a channel, turned by its EXIF orientation",
    tested_with="Pillow, OpenCV",
    sniff=magic(JPEG_MAGIC),
    read=decode_jpeg,
    write=encode_jpeg,
)
