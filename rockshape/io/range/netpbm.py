"""PGM z-depth in the camera's steps."""

from typing import TYPE_CHECKING

import numpy as np

from rockshape.errors import InputError
from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile


def read_pgm(file: "InputFile", _: ImageInfo) -> RangeRaster:
    """Z-depth (rows, cols) in steps; the file's greatest value stands for none.

    Source: Netpbm, pgm(5): of 16 bits the more significant byte comes first.
    Raises: InputError for anything but 16 bits of grey.
    """
    words = file.data.split(maxsplit=4)
    cols, rows, greatest = (int(word) for word in words[1:4])
    if not 255 < greatest < 65536:
        raise InputError(f"{file.path}: expected a PGM of 16 bits, found a maximum of {greatest}")
    file.check_shape((rows, cols), item_bytes=2)
    start = len(file.data) - 2 * rows * cols
    if cols <= 0 or rows <= 0 or start < len(b"P5 1 1 256 "):
        raise ValueError(f"{len(file.data)} bytes for {cols} x {rows} values")
    steps = np.frombuffer(file.data, ">u2", offset=start).reshape(rows, cols).astype(np.uint16)
    return RangeRaster(steps, unit="step", no_data=(float(greatest),))


FORMAT = RangeFormat(
    name="PGM",
    suffixes=(".pgm",),
    summary="z-depth (rows, cols), 16 bits, in steps of `depth_scale`, 0 for none",
    tested_with="OpenCV",
    sniff=magic(b"P5"),
    read=read_pgm,
)
