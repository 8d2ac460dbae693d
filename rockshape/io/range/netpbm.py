"""PGM z-depth in the camera's steps."""

from typing import TYPE_CHECKING

from rockshape.errors import InputError
from rockshape.io.decoding.pgm import pgm_numbers
from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile


def read_pgm(file: "InputFile", _: ImageInfo) -> RangeRaster:
    """Z-depth (rows, cols) in steps; the file's greatest value stands for none.

    Raises: InputError for anything but 16 bits of grey.
    """
    steps, greatest = pgm_numbers(file)
    if greatest < 256:
        raise InputError(f"{file.path}: expected a PGM of 16 bits, found a maximum of {greatest}")
    return RangeRaster(steps, unit="step", no_data=(float(greatest),))


FORMAT = RangeFormat(
    name="PGM",
    suffixes=(".pgm",),
    summary="z-depth (rows, cols), 16 bits, in steps of `depth_scale`, 0 for none",
    tested_with="OpenCV",
    sniff=magic(b"P5", b"P2"),
    read=read_pgm,
)
