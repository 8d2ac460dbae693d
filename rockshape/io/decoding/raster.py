"""Raster decoding and encoding: the pixels of image files as they are stored."""

import io
import warnings
from typing import TYPE_CHECKING

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

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
    return _picture(file.data)


def decode_tiff(file: "InputFile") -> NDArray[np.generic]:
    """Pixels (rows, cols) or (rows, cols, channels) of a TIFF of one page.

    Raises ValueError for several pages, and whatever tifffile does for a damaged file.
    """
    import tifffile  # noqa: PLC0415 - other images do without its 20 ms

    with tifffile.TiffFile(io.BytesIO(file.data)) as tiff:
        if len(tiff.series) > 1 or len(tiff.series[0].pages) > 1:
            raise ValueError(f"{len(tiff.pages)} pages")
        page = tiff.pages.first
        packed = page.compression not in UNPACKED
        if packed or page.photometric in (PALETTE, WHITE_IS_ZERO):
            return _picture(file.data)
        pixels = np.asarray(page.asarray())
    planes = pixels.ndim == 3 and page.planarconfig == SEPARATE_PLANES
    return np.moveaxis(pixels, 0, -1) if planes else pixels


def encode_raster(
    suffix: str, pixels: NDArray[np.uint8] | NDArray[np.uint16] | NDArray[np.integer]
) -> bytes:
    """File of pixels (rows, cols) or (rows, cols, 3) RGB in the format that a suffix names."""
    image = cv2.cvtColor(pixels, cv2.COLOR_RGB2BGR) if pixels.ndim == 3 else pixels
    return cv2.imencode(suffix, image)[1].tobytes()


def _picture(data: bytes) -> NDArray[np.generic]:
    with warnings.catch_warnings():
        warnings.simplefilter("error", Image.DecompressionBombWarning)
        with Image.open(io.BytesIO(data)) as picture:
            picture.load()
            if picture.mode in ("P", "PA", "CMYK", "YCbCr", "LAB", "HSV"):
                return np.asarray(picture.convert("RGB"))
            if picture.mode == "1":
                return np.asarray(picture.convert("L"))
            return np.asarray(picture)
