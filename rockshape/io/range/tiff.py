"""TIFF range."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.raster import TIFF_MAGIC, decode_tiff
from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile


def read_tiff(file: "InputFile", _: ImageInfo) -> RangeRaster:
    """Z-depth (rows, cols) or points (rows, cols, 3), m."""
    return RangeRaster(decode_tiff(file))


FORMAT = RangeFormat(
    name="TIFF",
    suffixes=(".tif", ".tiff"),
    summary="one page of z-depth (rows, cols) or points (rows, cols, 3), m",
    sniff=magic(*TIFF_MAGIC),
    read=read_tiff,
)
