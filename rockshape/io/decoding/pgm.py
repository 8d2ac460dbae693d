"""Numbers of a PGM file as they are stored, whatever its greatest level."""

import re
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

GAP = rb"(?:\s|#[^\n]*\n)+"
HEADER = re.compile(rb"P([25])" + 3 * (GAP + rb"(\d{1,9})") + rb"\s")
COMMENT = re.compile(rb"#[^\n]*")


def pgm_numbers(file: "InputFile") -> tuple[NDArray[Any], int]:
    """Numbers (rows, cols) of 8 or 16 bits of a PGM, text or binary, and its greatest level.

    Raises: ValueError for a damaged header or too few numbers, InputError for too many pixels.
    Source: Netpbm, pgm(5): of 16 bits the more significant byte comes first.
    """
    header = HEADER.match(file.data)
    if header is None:
        raise ValueError("a damaged header")
    cols, rows, greatest = (int(word) for word in header.groups()[1:])
    if not 0 < greatest < 65536:
        raise ValueError(f"a greatest level of {greatest}")
    kind = np.dtype(np.uint8 if greatest < 256 else ">u2")
    file.check_shape((rows, cols), item_bytes=kind.itemsize)
    if header[1] == b"5":
        numbers = np.frombuffer(file.data, kind, count=rows * cols, offset=header.end())
    else:
        words = COMMENT.sub(b"", file.data[header.end() :]).split()[: rows * cols]
        numbers = np.array([int(word) for word in words], dtype=np.int64)
    return numbers.reshape(rows, cols).astype(kind.newbyteorder("=")), greatest
