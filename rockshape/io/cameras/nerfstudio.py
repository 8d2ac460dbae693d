"""Cameras of nerfstudio's and instant-ngp's transforms.json."""

import re
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

import msgspec
import numpy as np

from rockshape.camera.lens import Lens
from rockshape.errors import InputError
from rockshape.io.decoding.intrinsics import (
    CORNER_ORIGIN,
    chosen_view,
    decode_json,
    distortion_of,
    intrinsic_matrix,
    lens_of,
)
from rockshape.io.format import CameraFormat, ImageInfo

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

_KEY = re.compile(rb'"(fl_x|camera_angle_x|transform_matrix)"\s*:')
FISHEYE = ("OPENCV_FISHEYE", "FISHEYE")
PINHOLES = ("OPENCV", "PINHOLE", "SIMPLE_PINHOLE", "SIMPLE_RADIAL", "RADIAL", "PERSPECTIVE")


class _Intrinsics(msgspec.Struct):
    fl_x: float | None = None
    fl_y: float | None = None
    cx: float | None = None
    cy: float | None = None
    w: float | None = None
    h: float | None = None
    camera_angle_x: float | None = None  # rad
    camera_model: str = "OPENCV"
    is_fisheye: bool = False
    k1: float = 0.0
    k2: float = 0.0
    k3: float = 0.0
    k4: float = 0.0
    p1: float = 0.0
    p2: float = 0.0


class _Frames(msgspec.Struct):
    frames: list[dict[str, object]] = []


def read_transforms(file: "InputFile", info: ImageInfo | None) -> Lens:
    """Camera of the file, or of the frame whose file_path is the image where frames have their own.

    Source: nerfstudio, docs/quickstart/data_conventions.md; the first pixel's corner is (0, 0).
    Raises: InputError for a camera model that is neither a pinhole nor a fisheye.
    """
    found = decode_json(file, _Intrinsics)
    frames = decode_json(file, _Frames).frames
    own = [msgspec.convert(frame, _Intrinsics) for frame in frames if "fl_x" in frame]
    if own:
        names = [_stem(frame) for frame in frames if "fl_x" in frame]
        same = all(one == own[0] for one in own)
        chosen = own[names.index(chosen_view(names, info, same=same))]
        for name in _Intrinsics.__struct_fields__:
            if getattr(chosen, name) != getattr(_Intrinsics(), name):
                setattr(found, name, getattr(chosen, name))
    return _lens(found, info)


def _lens(found: _Intrinsics, info: ImageInfo | None) -> Lens:
    model = found.camera_model.upper()
    fisheye = model in FISHEYE or found.is_fisheye
    if not fisheye and model not in PINHOLES:
        raise InputError(
            f"camera: camera_model: expected {', '.join((*PINHOLES, *FISHEYE))}, "
            f"found {found.camera_model!r}"
        )
    width, height = found.w, found.h
    if width is None and height is None and info is not None:
        height, width = info.shape
    if width is None or height is None or width % 1 or height % 1:
        raise InputError(f"camera: w, h: expected whole numbers of px, found {width}, {height}")
    focal = found.fl_x
    if focal is None and found.camera_angle_x is not None:
        focal = width / 2 / float(np.tan(found.camera_angle_x / 2))
    if focal is None:
        raise InputError("camera: fl_x: expected a focal length, px, found none")
    k = intrinsic_matrix(
        focal,
        focal if found.fl_y is None else found.fl_y,
        width / 2 if found.cx is None else found.cx,
        height / 2 if found.cy is None else found.cy,
    )
    terms = [found.k1, found.k2, found.p1, found.p2, found.k3]
    if fisheye:
        terms = [found.k1, found.k2, found.k3, found.k4]
    elif found.k4:
        raise InputError(f"camera: k4: expected 0 but of a fisheye, found {found.k4}")
    return lens_of(
        k,
        (int(width), int(height)),
        info,
        distortion=distortion_of(terms, "fisheye" if fisheye else "brown"),
        origin=CORNER_ORIGIN,
    )


def _stem(frame: dict[str, object]) -> str:
    return PurePosixPath(str(frame.get("file_path", "")).replace("\\", "/")).stem


FORMAT = CameraFormat(
    name="nerfstudio",
    suffixes=(".json",),
    summary="transforms.json with `fl_x`, `fl_y`, `cx`, `cy`, `w`, `h`, px, `k1`, `k2`, `p1`, "
    "`p2`; or `camera_angle_x`, rad; a frame's own come first",
    tested_with="nerfstudio data conventions",
    sniff=lambda head: _KEY.search(head) is not None,
    read=read_transforms,
)
