"""PNG z-depth in the camera's steps, as depth cameras and BOP store it."""

from typing import TYPE_CHECKING

import numpy as np

from rockshape.errors import InputError
from rockshape.io.decoding.raster import PNG_MAGIC, decode_picture
from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile


def read_png(file: "InputFile", _: ImageInfo) -> RangeRaster:
    """Z-depth (rows, cols) in steps. Raises: InputError for anything but 16 bits of grey."""
    steps = decode_picture(file)
    if steps.dtype != np.uint16 or steps.ndim != 2:
        raise InputError(
            f"{file.path}: expected a grey PNG of 16 bits, found {steps.dtype} {steps.shape}"
        )
    return RangeRaster(steps, unit="step")


FORMAT = RangeFormat(
    name="PNG",
    suffixes=(".png",),
    summary="z-depth (rows, cols), 16 bits, in steps of the camera's `depth_scale`, 0 for none",
    tested_with="OpenCV",
    sniff=magic(PNG_MAGIC),
    read=read_png,
)
