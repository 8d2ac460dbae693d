"""Middlebury's calib.txt of a rectified stereo pair."""

import re
from typing import TYPE_CHECKING

import numpy as np

from rockshape.camera.lens import DisparityScale, Lens
from rockshape.errors import InputError
from rockshape.io.decoding.intrinsics import lens_of, text_of
from rockshape.io.format import CameraFormat, ImageInfo

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

_START = re.compile(rb"^cam0\s*=\s*\[", re.MULTILINE)
_LINE = re.compile(r"^\s*(\w+)\s*=\s*(.+?)\s*$", re.MULTILINE)


def read_calib(file: "InputFile", info: ImageInfo | None) -> Lens:
    """Left camera of a pair, with baseline and the offset between the principal points.

    Source: Middlebury Stereo Evaluation v3, "calibration file format": Z = baseline f/(d + doffs),
    baseline in mm.
    """
    values = dict(_LINE.findall(text_of(file).decode()))
    missing = [name for name in ("cam0", "baseline") if name not in values]
    if missing:
        raise file.refusal(f"no {' and no '.join(missing)}")
    rows = values["cam0"].strip("[]").split(";")
    k = np.array([[float(word) for word in row.split()] for row in rows])
    try:
        size = tuple(int(values[name]) if name in values else None for name in ("width", "height"))
        scale = DisparityScale(float(values["baseline"]) / 1000, float(values.get("doffs", "0")))
    except ValueError as error:
        raise InputError(f"camera: expected numbers, found: {error}") from None
    return lens_of(k, (size[0], size[1]), info, disparity=scale)


FORMAT = CameraFormat(
    name="Middlebury",
    suffixes=(".txt",),
    summary="calib.txt with `cam0`, `baseline`, mm, `doffs`, `width`, `height`, px",
    tested_with="Middlebury Stereo Evaluation 3",
    sniff=lambda head: _START.search(head) is not None,
    read=read_calib,
)
