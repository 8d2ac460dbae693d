"""Organised PCD point clouds, by pypcd4, the extra `pcd`."""

import io
import re
from typing import TYPE_CHECKING, Any

import numpy as np

from rockshape.errors import InputError
from rockshape.io.format import ImageInfo, RangeFormat, RangeRaster

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

_START = re.compile(rb"(\s*#[^\n]*\n)*\s*VERSION\s", re.IGNORECASE)
_SIDE = re.compile(rb"^(WIDTH|HEIGHT)\s+(\d+)", re.MULTILINE)


def read_pcd(file: "InputFile", info: ImageInfo) -> RangeRaster:
    """Points (rows, cols, 3), m, of a cloud as wide and high as the image, or as many in one row.

    Raises: InputError where pypcd4 is not installed, and for a cloud of another size.
    Source: Point Cloud Library, the PCD file format, version 0.7.
    """
    try:
        from pypcd4.pypcd4 import PointCloud  # noqa: PLC0415 - of an extra
    except ImportError:
        raise InputError(
            f"{file.path}: PCD: expected the package pypcd4 (pip install 'rockshape[pcd]'), "
            f"found none"
        ) from None
    sides = {name.upper(): int(value) for name, value in _SIDE.findall(file.head)}
    rows, cols = sides.get(b"HEIGHT", 0), sides.get(b"WIDTH", 0)
    file.check_shape((rows, cols, 4), item_bytes=4)
    if (rows, cols) != info.shape and (rows, cols) != (1, info.shape[0] * info.shape[1]):
        raise file.refusal(f"{cols} x {rows} points, not {info.shape[1]} x {info.shape[0]}")
    stream: Any = io.BytesIO(file.data)
    points = PointCloud.from_fileobj(stream).numpy(("x", "y", "z"))
    return RangeRaster(np.asarray(points).reshape(*info.shape, 3))


FORMAT = RangeFormat(
    name="PCD",
    suffixes=(".pcd",),
    summary="organised cloud as wide and high as the image, ASCII, binary or compressed, m; with "
    "the extra `pcd`",
    tested_with="pypcd4",
    sniff=lambda head: _START.match(head) is not None,
    read=read_pcd,
)
