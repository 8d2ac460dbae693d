"""Organised PLY point clouds."""

import io
from typing import TYPE_CHECKING

import numpy as np

from rockshape.errors import InputError
from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster, magic

if TYPE_CHECKING:
    from rockshape.io.files import InputFile


def read_ply(file: "InputFile", info: ImageInfo) -> RangeRaster:
    """Points (rows, cols, 3), m, from one vertex a pixel in the image's reading order.

    Raises: InputError for another number of vertices.
    """
    from trimesh.exchange.ply import load_ply  # noqa: PLC0415 - it takes 0.3 s

    vertices = np.asarray(load_ply(io.BytesIO(file.data), fix_texture=False)["vertices"])
    rows, cols = info.shape
    if vertices.shape != (rows * cols, 3):
        raise InputError(
            f"{file.path}: expected a vertex for each of {rows} x {cols} pixels, "
            f"found {len(vertices)}"
        )
    return RangeRaster(vertices.reshape(rows, cols, 3))


FORMAT = RangeFormat(
    name="PLY",
    suffixes=(".ply",),
    summary="one vertex a pixel, in the image's reading order, m",
    tested_with="trimesh",
    sniff=magic(b"ply\n", b"ply\r"),
    read=read_ply,
)
