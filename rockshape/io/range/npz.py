"""NumPy archives with range under the key xyz or depth."""

from typing import TYPE_CHECKING

from rockshape.io.decoding.numpy_files import ZIP_MAGIC, load_npz
from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

KEYS = ("xyz", "depth")


def read_npz(file: "InputFile", _: ImageInfo) -> RangeRaster:
    """Points (rows, cols, 3) under xyz or z-depth (rows, cols) under depth, m.

    Raises: InputError where the archive has neither.
    """
    return RangeRaster(load_npz(file, KEYS))


FORMAT = RangeFormat(
    name="NPZ",
    suffixes=(".npz",),
    summary="array `xyz` of points (rows, cols, 3), else `depth` of z-depth (rows, cols), m, "
    "or whole steps of `depth_scale`",
    tested_with="NumPy",
    sniff=magic(ZIP_MAGIC),
    read=read_npz,
)
