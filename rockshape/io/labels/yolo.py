"""YOLO segmentation labels of one image.

Source: Ultralytics' segmentation data set format: a line a rock, its class and then x and y of its
corners in fractions of the image's width and height.
"""

import re
from typing import TYPE_CHECKING

import numpy as np

from rockshape.io.decoding.outlined import Entry, UnreadableError, collect, polygons_mask
from rockshape.io.decoding.polygons import BoxedMask
from rockshape.io.format import ImageInfo, LabelFormat

if TYPE_CHECKING:
    from rockshape.io.files import InputFile
    from rockshape.rock.instances import Instances

_NUMBER = rb"[-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?"
_LINE = re.compile(rb"(\xef\xbb\xbf)?\s*[0-9]+(\.0+)?((\s+" + _NUMBER + rb"){4,}\s*?(\r?\n|$))")
SLACK = 0.01  # by which an annotator's corner may lie outside the image
BOX_NUMBERS = 4


def is_yolo(head: bytes) -> bool:
    """Whether content begins with a line of a class and at least two pairs of numbers."""
    return bool(_LINE.match(head))


def read_yolo(file: "InputFile", info: ImageInfo) -> "Instances":
    """Instances of the polygons, each with the number of its line.

    Boxes have no outline: they are left out, and a note counts them.
    Raises: InputError for text that holds no such lines.
    """
    text = file.data.decode("utf-8-sig")
    lines = enumerate(text.splitlines(), start=1)
    entries = [_entry(number, line.split(), info) for number, line in lines if line.strip()]
    return collect(file, info, entries, noun="line")


def _entry(number: int, words: list[str], info: ImageInfo) -> Entry:
    return Entry(number, lambda: _mask(words, info))


def _mask(words: list[str], info: ImageInfo) -> BoxedMask | None:
    try:
        numbers = np.array(words[1:], dtype=np.float64)
    except ValueError:
        raise UnreadableError("with words in place of numbers") from None
    if len(numbers) in (BOX_NUMBERS, BOX_NUMBERS + 1):
        raise UnreadableError("box without an outline")
    corners = numbers[: len(numbers) // 2 * 2].reshape(-1, 2)  # an odd one is a confidence
    if not ((corners >= -SLACK) & (corners <= 1 + SLACK)).all():
        raise UnreadableError("with corners that are no fractions of the image")
    rows, cols = info.shape
    return polygons_mask([[corners * (cols, rows)]], info.shape)


FORMAT = LabelFormat(
    name="YOLO segmentation",
    suffixes=(".txt",),
    summary="a line a rock: class, then x and y of its corners in fractions of the image's size",
    tested_with="Ultralytics data format",
    sniff=is_yolo,
    read=read_yolo,
)
