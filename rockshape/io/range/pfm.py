"""Portable float maps."""

import re
from typing import TYPE_CHECKING

import numpy as np

from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

WIDTHS = {b"Pf": 1, b"PF": 3}
# magic number, columns, rows and scale; one byte of white space after the last
HEADER = re.compile(rb"(P[fF])\s+(\d+)\s+(\d+)\s+(\S+)\s")


def read_pfm(file: "InputFile", _: ImageInfo) -> RangeRaster:
    """Z-depth (rows, cols) or points (rows, cols, 3), m; rows are stored from the bottom up.

    Source: Debevec, "PFM: portable float map": a negative scale means little-endian numbers.
    """
    header = HEADER.match(file.data)
    if header is None:
        raise ValueError("a header without magic number, columns, rows and scale")
    width = WIDTHS[header[1]]
    cols, rows, scale = int(header[2]), int(header[3]), float(header[4])
    if cols <= 0 or rows <= 0 or not (np.isfinite(scale) and scale):
        raise ValueError(f"{cols} x {rows} values of scale {scale}")
    file.check_shape((rows, cols, width), item_bytes=4)
    order = "<f4" if scale < 0 else ">f4"
    values = np.frombuffer(file.data, order, count=rows * cols * width, offset=header.end())
    raster = values.reshape(rows, cols, width)[::-1].astype(np.float32) * np.float32(abs(scale))
    return RangeRaster(raster[..., 0] if width == 1 else raster)


FORMAT = RangeFormat(
    name="PFM",
    suffixes=(".pfm",),
    summary="z-depth, or points of a file of three channels, m; disparity by `--range-kind`",
    tested_with="Debevec, PFM",
    sniff=magic(b"Pf\n", b"PF\n", b"Pf ", b"PF "),
    read=read_pfm,
)
