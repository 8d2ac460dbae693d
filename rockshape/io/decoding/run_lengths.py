"""Run lengths down the columns, plain or compressed, as pycocotools writes them.

Source: pycocotools 2.0, common/maskApi.c, rleToString and rleFrString.
"""

from math import prod

import numpy as np
from numpy.typing import NDArray

from rockshape.io.decoding.polygons import BoxedMask, boxed

CHARACTER_BITS, MORE, SIGN, FIRST_CHARACTER = 5, 0x20, 0x10, 48
MAX_CHARACTERS = 7  # of one count: 35 bits


def decode_run_lengths(counts: object, shape: tuple[int, int]) -> BoxedMask | None:
    """Pixels that run lengths over an image cover, zeros first; None for no pixel.

    Raises: ValueError for what are no counts, for negative ones, and where they do not add up.
    """
    if isinstance(counts, str):
        counts = expand_counts(counts)
    if not isinstance(counts, list) or not all(type(count) is int for count in counts):
        raise ValueError("no run lengths")
    if min(counts, default=0) < 0:
        raise ValueError("negative run lengths")
    if sum(counts) != prod(shape):
        raise ValueError(f"run lengths over {sum(counts)} pixels in place of {prod(shape)}")
    covered: NDArray[np.bool_] = np.repeat(np.arange(len(counts)) % 2 == 1, counts)
    return boxed(covered.reshape(shape, order="F"))


def expand_counts(text: str) -> list[int]:
    """Counts of a compressed string. Raises: ValueError where it is none."""
    counts: list[int] = []
    value = shift = 0
    for character in text:
        code = ord(character) - FIRST_CHARACTER
        if not 0 <= code < 2 * MORE or shift >= CHARACTER_BITS * MAX_CHARACTERS:
            raise ValueError("damaged compressed run lengths")
        value |= (code & (MORE - 1)) << shift
        shift += CHARACTER_BITS
        if code & MORE:
            continue
        if code & SIGN:
            value -= 1 << shift
        counts.append(value + counts[-2] if len(counts) > 2 else value)
        value = shift = 0
    if shift:
        raise ValueError("compressed run lengths that end within a count")
    return counts
