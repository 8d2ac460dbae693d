"""NumPy range arrays."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.numpy_files import NPY_MAGIC, load_npy
from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile


def read_npy(file: "InputFile", _: ImageInfo) -> RangeRaster:
    """Z-depth (rows, cols) or points (rows, cols, 3), m."""
    return RangeRaster(load_npy(file))


FORMAT = RangeFormat(
    name="NPY",
    suffixes=(".npy",),
    summary="array of z-depth (rows, cols) or points (rows, cols, 3), m, or whole steps of "
    "`depth_scale`",
    tested_with="NumPy",
    sniff=magic(NPY_MAGIC),
    read=read_npy,
)
