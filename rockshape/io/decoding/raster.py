"""Raster encoding, and the numbers of PNG and TIFF files as they are stored."""

from typing import TYPE_CHECKING, Any

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.io.decoding.pillow import read_numbers
from rockshape.io.decoding.tiff import TIFF_MAGIC, read_tiff

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

PNG_MAGIC = b"\x89PNG\r\n\x1a\n"
PNG_BITS = 24  # where in the file the bits a sample are told

__all__ = ["PNG_MAGIC", "TIFF_MAGIC", "decode_picture", "decode_tiff", "encode_raster"]


def decode_picture(file: "InputFile") -> NDArray[Any]:
    """Stored numbers (rows, cols) of a grey PNG or the indices of one with a palette."""
    bits = file.head[PNG_BITS] if len(file.head) > PNG_BITS else 8
    return read_numbers(file, "PNG", bits=bits)


def decode_tiff(file: "InputFile") -> NDArray[Any]:
    """Stored numbers (rows, cols) or (rows, cols, channels) of a TIFF of one page."""
    return read_tiff(file).values


def encode_raster(
    suffix: str, pixels: NDArray[np.uint8] | NDArray[np.uint16] | NDArray[np.integer]
) -> bytes:
    """File of pixels (rows, cols) or (rows, cols, 3) RGB in the format that a suffix names."""
    image = cv2.cvtColor(pixels, cv2.COLOR_RGB2BGR) if pixels.ndim == 3 else pixels
    return cv2.imencode(suffix, image)[1].tobytes()
