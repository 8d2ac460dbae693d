"""Pillow's formats: pictures as colours, label images as their stored numbers."""

import io
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import chain
from typing import IO, TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from rockshape.errors import InputError
from rockshape.io.decoding.orientation import TAG, UPRIGHT, turn
from rockshape.io.format import ImageContent

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

LARGE_PIXELS, STRIP_ROWS = 2**24, 512
COLOURS = ("P", "PA", "CMYK", "YCbCr", "LAB", "HSV")
# what Pillow multiplies grey levels of fewer than 8 bits by, to fill these
LEVELS = {1: 255, 2: 85, 4: 17}


def read_picture(file: "InputFile", *formats: str) -> ImageContent:
    """ImageContent of a file in one of Pillow's formats, turned as its orientation tag says.

    A palette becomes its colours. Raises: InputError for more pixels than the file may have, and
    whatever Pillow does for a damaged file.
    """
    with open_picture(file, io.BytesIO(file.data), formats) as picture:
        orientation = orientation_left(picture)
        picture.load()
        pixels = native_pixels(picture.convert("RGB") if picture.mode in COLOURS else picture)
    return ImageContent(turn(pixels, orientation), orientation=orientation)


def read_numbers(file: "InputFile", *formats: str, bits: int = 8) -> NDArray[Any]:
    """Numbers (rows, cols) that the file stores, a palette's indices; bits a pixel of grey.

    Colours whose channels are equal and opaque are as good as grey.
    Raises: InputError for any other colours.
    """
    with open_picture(file, io.BytesIO(file.data), formats) as picture:
        orientation = orientation_left(picture)
        picture.load()
        mode = picture.mode
        numbers = native_pixels(picture.getchannel("P") if mode == "PA" else picture)
    if mode == "1":
        numbers = numbers.astype(np.uint8)
    elif mode == "L":
        numbers = numbers // np.uint8(LEVELS.get(bits, 1))
    return turn(_one_channel(file, numbers, opaque=mode in ("LA", "RGBA")), orientation)


def _one_channel(file: "InputFile", numbers: NDArray[Any], *, opaque: bool) -> NDArray[Any]:
    """First of channels that all tell the same; with `opaque` the last is an alpha."""
    if numbers.ndim == 2:
        return numbers
    tellers = numbers[..., :-1] if opaque else numbers
    if (opaque and not (numbers[..., -1] == numbers[..., -1].max()).all()) or (
        tellers != tellers[..., :1]
    ).any():
        raise InputError(
            f"{file.path}: expected one number a pixel, found colours; "
            f"save the numbers as grey levels"
        )
    return numbers[..., 0]


def native_pixels(picture: Image.Image) -> NDArray[Any]:
    """Pixels in the machine's byte order; 16 bits that Pillow holds in 32 are 16 again."""
    pixels = _by_strips(picture)
    if picture.mode.startswith("I;16") or (
        picture.mode == "I" and pixels.size and 0 <= pixels.min() <= pixels.max() <= 65535
    ):
        return pixels.astype(np.uint16)
    return pixels


def _by_strips(picture: Image.Image) -> NDArray[Any]:
    """Pixels of a picture; Pillow's own conversion holds a large one three times at once."""
    width, height = picture.size
    if width * height < LARGE_PIXELS:
        return np.asarray(picture)
    tops = range(0, height, STRIP_ROWS)
    boxes = ((0, top, width, min(top + STRIP_ROWS, height)) for top in tops)
    strips = (np.asarray(picture.crop(box)) for box in boxes)
    first = next(strips)
    pixels = np.empty((height, *first.shape[1:]), first.dtype)
    for top, strip in zip(tops, chain([first], strips), strict=True):
        pixels[top : top + len(strip)] = strip
    return pixels


def orientation_left(picture: Image.Image) -> int:
    """Orientation by which a picture has still to be turned: Pillow turns TIFF itself."""
    found = picture.getexif().get(TAG, UPRIGHT)
    return found if found in range(1, 9) else UPRIGHT


@contextmanager
def open_picture(
    file: "InputFile", stream: IO[bytes], formats: tuple[str, ...]
) -> Iterator[Image.Image]:
    """Picture whose size is checked, without Pillow's own limit, which is not the user's."""
    limit, Image.MAX_IMAGE_PIXELS = Image.MAX_IMAGE_PIXELS, None
    try:
        with Image.open(stream, formats=formats) as picture:
            file.check_shape((picture.height, picture.width, len(picture.getbands())))
            yield picture
    finally:
        Image.MAX_IMAGE_PIXELS = limit
