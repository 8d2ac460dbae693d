"""Range as text: a line a pixel of x, y and z in metres, in reading order."""

import io

import numpy as np

from rockshape.io import ImageInfo, InputFile, RangeFormat, RangeRaster


def read_xyz(file: InputFile, info: ImageInfo) -> RangeRaster:
    """Points (rows, cols, 3), m."""
    values = np.loadtxt(io.BytesIO(file.data))
    return RangeRaster(values.reshape(*info.shape, 3))


FORMAT = RangeFormat(
    name="XYZ text",
    suffixes=(".xyz",),
    summary="a line a pixel: x, y, z, m",
    read=read_xyz,
)
