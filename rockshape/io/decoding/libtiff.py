"""Compressed and packed TIFF pages, by the libtiff that Pillow and OpenCV bring.

Pillow keeps the numbers of up to 8 bits, OpenCV those of more.
"""

import io
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.io.decoding.orientation import TAG, UPRIGHT, turn
from rockshape.io.decoding.pillow import LEVELS, native_pixels, open_picture, orientation_left
from rockshape.io.guard import quiet_libraries_in_c

if TYPE_CHECKING:
    from tifffile import TiffPage

    from rockshape.io.files import InputFile

WHITE_IS_ZERO, SEPARATE_PLANES = 0, 2  # photometric interpretation, planar configuration
MODES = ("1", "L", "P", "LA", "PA", "RGB", "RGBA", "I;16")


def by_libtiff(file: "InputFile", page: "TiffPage") -> NDArray[Any]:
    """Stored numbers (rows, cols) or (rows, cols, channels) of a page, turned as its tag says.

    Raises: InputError for what neither library reads without loss.
    """
    bits = int(np.max(page.bitspersample))
    values = _few_bits(file, page, bits) if bits < 16 else _many_bits(file, page)
    if values is None:
        raise InputError(
            f"{file.path}: expected a TIFF without compression or by Deflate, or a common "
            f"compression of whole bytes, found {page.compression!r} of {bits} bits"
        )
    return values


def orientation_of(page: "TiffPage") -> int:
    """Orientation tag of a page, 1 to 8."""
    found = page.tags.valueof(TAG, default=UPRIGHT)
    return int(found) if found in range(1, 9) else UPRIGHT


def _few_bits(file: "InputFile", page: "TiffPage", bits: int) -> NDArray[Any] | None:
    """Numbers of up to 12 bits; what Pillow shows the other way round is turned back."""
    with open_picture(file, io.BytesIO(file.data), ("TIFF",)) as picture:
        picture.seek(page.index)
        with quiet_libraries_in_c():
            picture.load()
        if picture.mode not in MODES or page.dtype is None or page.dtype.kind == "i":
            return None
        values, left = native_pixels(picture), orientation_left(picture)
    if page.photometric == WHITE_IS_ZERO and picture.mode in ("1", "L"):
        values = ~values
    if picture.mode == "L":
        values = values // np.uint8(LEVELS.get(bits, 1))
    return turn(values, left)


def _many_bits(file: "InputFile", page: "TiffPage") -> NDArray[Any] | None:
    import cv2  # noqa: PLC0415 - few files need it

    if page.planarconfig == SEPARATE_PLANES and page.samplesperpixel > 1:
        return None
    data = np.frombuffer(file.data, np.uint8)
    with quiet_libraries_in_c():
        done, pages = cv2.imdecodemulti(data, cv2.IMREAD_UNCHANGED)
    if not done or page.index >= len(pages) or pages[page.index].dtype != page.dtype:
        return None
    values = np.asarray(pages[page.index])
    if values.ndim == 3:
        values = values[..., [2, 1, 0, *range(3, values.shape[2])]]
    return turn(values, orientation_of(page))
