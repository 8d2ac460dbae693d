"""JPEG images."""

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.io.decoding.raster import decode_picture, encode_raster
from rockshape.io.format import ImageFormat, magic


def encode_jpeg(pixels: NDArray[np.uint8] | NDArray[np.uint16]) -> bytes:
    """JPEG of 8-bit pixels. Raises: InputError for 16 bits."""
    if pixels.dtype != np.uint8:
        raise InputError(f"expected 8 bits a channel for JPEG, found {pixels.dtype}")
    return encode_raster(".jpg", pixels)


FORMAT = ImageFormat(
    name="JPEG",
    suffixes=(".jpg", ".jpeg"),
    summary="grey or colour, 8 bits a channel",
    sniff=magic(b"\xff\xd8\xff"),
    read=decode_picture,
    write=encode_jpeg,
)
