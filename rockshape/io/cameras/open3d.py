"""Open3D's camera intrinsics in JSON."""

import re
from typing import TYPE_CHECKING

import msgspec
import numpy as np

from rockshape.camera.lens import Lens
from rockshape.io.decoding.intrinsics import decode_json, lens_of, matrix, refuse_unread_terms
from rockshape.io.format import CameraFormat, ImageInfo

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

_KEY = re.compile(rb'"intrinsic_matrix"\s*:')


class _Intrinsic(msgspec.Struct):
    intrinsic_matrix: list[float]  # by columns
    width: int
    height: int


class _Parameters(msgspec.Struct):
    intrinsic: _Intrinsic | None = None  # of PinholeCameraParameters
    intrinsic_matrix: list[float] | None = None
    width: int | None = None
    height: int | None = None


def read_open3d(file: "InputFile", info: ImageInfo | None) -> Lens:
    """Camera of a PinholeCameraIntrinsic or PinholeCameraParameters.

    Source: Open3D, `PinholeCameraIntrinsic::ConvertToJsonValue`: the matrix is by columns.
    """
    refuse_unread_terms(decode_json(file, dict[str, object]), _Parameters)
    found = decode_json(file, _Parameters).intrinsic
    found = found or decode_json(file, _Intrinsic)
    by_columns = np.transpose(matrix(found.intrinsic_matrix, (3, 3), "intrinsic_matrix"))
    return lens_of(by_columns, (found.width, found.height), info)


FORMAT = CameraFormat(
    name="Open3D",
    suffixes=(".json",),
    summary="`intrinsic_matrix` by columns, `width`, `height`, px",
    tested_with="Open3D, ConvertToJsonValue",
    sniff=lambda head: _KEY.search(head) is not None,
    read=read_open3d,
)
