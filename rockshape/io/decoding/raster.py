"""Raster decoding and encoding: the pixels of image files as they are stored."""

import io
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from rockshape.io.decoding.tiff_directories import check_directories

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

PNG_MAGIC = b"\x89PNG\r\n\x1a\n"
TIFF_MAGIC = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
WHITE_IS_ZERO, PALETTE, SEPARATE_PLANES = 0, 3, 2  # values of TIFF's tags
UNPACKED = (1, 8, 32946, 32773)  # TIFF compressions that tifffile decodes by itself


def decode_picture(file: "InputFile") -> NDArray[np.generic]:
    """Pixels (rows, cols) or (rows, cols, channels) of a PNG or JPEG; a palette as its colours.

    Raises whatever Pillow does for a damaged file.
    """
    return _picture(file)


def decode_tiff(file: "InputFile") -> NDArray[np.generic]:
    """Pixels (rows, cols) or (rows, cols, channels) of a TIFF of one page.

    Raises ValueError for several pages, and whatever tifffile does for a damaged file.
    """
    import tifffile  # noqa: PLC0415 - other images do without its 20 ms

    check_directories(file.data)
    with tifffile.TiffFile(io.BytesIO(file.data)) as tiff:
        if len(tiff.series) > 1 or len(tiff.series[0].pages) > 1:
            raise ValueError(f"{len(tiff.pages)} pages")
        page = tiff.pages.first
        file.check_shape(page.shape, item_bytes=max(page.bitspersample // 8, 1))
        packed = page.compression not in UNPACKED
        if packed or page.photometric in (PALETTE, WHITE_IS_ZERO):
            return _picture(file)
        pixels = np.asarray(page.asarray())
    planes = pixels.ndim == 3 and page.planarconfig == SEPARATE_PLANES
    return np.moveaxis(pixels, 0, -1) if planes else pixels


def encode_raster(
    suffix: str, pixels: NDArray[np.uint8] | NDArray[np.uint16] | NDArray[np.integer]
) -> bytes:
    """File of pixels (rows, cols) or (rows, cols, 3) RGB in the format that a suffix names."""
    image = cv2.cvtColor(pixels, cv2.COLOR_RGB2BGR) if pixels.ndim == 3 else pixels
    return cv2.imencode(suffix, image)[1].tobytes()


def _picture(file: "InputFile") -> NDArray[np.generic]:
    with unlimited(), Image.open(io.BytesIO(file.data)) as picture:
        file.check_shape((picture.height, picture.width, len(picture.getbands())))
        picture.load()
        if picture.mode in ("P", "PA", "CMYK", "YCbCr", "LAB", "HSV"):
            return np.asarray(picture.convert("RGB"))
        if picture.mode == "1":
            return np.asarray(picture.convert("L"))
        return np.asarray(picture)


@contextmanager
def unlimited() -> Iterator[None]:
    """Pillow without its own limit of pixels, which is lower and not the user's."""
    limit, Image.MAX_IMAGE_PIXELS = Image.MAX_IMAGE_PIXELS, None
    try:
        yield
    finally:
        Image.MAX_IMAGE_PIXELS = limit
