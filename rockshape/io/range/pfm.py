"""Portable float maps."""

from typing import TYPE_CHECKING

import numpy as np

from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

WIDTHS = {b"Pf": 1, b"PF": 3}


def read_pfm(file: "InputFile", _: ImageInfo) -> RangeRaster:
    """Z-depth (rows, cols) or points (rows, cols, 3), m; rows are stored from the bottom up.

    Source: Debevec, "PFM: portable float map": a negative scale means little-endian numbers.
    """
    words = file.data.split(maxsplit=4)  # magic number, columns, rows, scale
    width = WIDTHS[words[0]]
    cols, rows, scale = int(words[1]), int(words[2]), float(words[3])
    if cols <= 0 or rows <= 0 or not (np.isfinite(scale) and scale):
        raise ValueError(f"{cols} x {rows} values of scale {scale}")
    file.check_shape((rows, cols, width), item_bytes=4)
    start = _header_bytes(file.data)
    values = np.frombuffer(
        file.data, "<f4" if scale < 0 else ">f4", count=rows * cols * width, offset=start
    )
    raster = values.reshape(rows, cols, width)[::-1].astype(np.float32) * np.float32(abs(scale))
    return RangeRaster(raster[..., 0] if width == 1 else raster)


def _header_bytes(data: bytes) -> int:
    """Length of the header: four words, and one byte of white space after the last."""
    place = 0
    for _ in range(4):
        while data[place : place + 1].isspace():
            place += 1
        while not data[place : place + 1].isspace():
            place += 1
    return place + 1


FORMAT = RangeFormat(
    name="PFM",
    suffixes=(".pfm",),
    summary="z-depth, or points of a file of three channels, m; disparity by `--range-kind`",
    tested_with="Debevec, PFM",
    sniff=magic(b"Pf\n", b"PF\n", b"Pf ", b"PF "),
    read=read_pfm,
)
