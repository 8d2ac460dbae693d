"""Intrinsics of RealSense cameras in JSON."""

import re
from typing import TYPE_CHECKING

import msgspec

from rockshape.camera.lens import Lens
from rockshape.errors import InputError
from rockshape.io.decoding.intrinsics import (
    Model,
    decode_json,
    distortion_of,
    intrinsic_matrix,
    lens_of,
    refuse_unread_terms,
)
from rockshape.io.format import CameraFormat, ImageInfo

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

_KEY = re.compile(rb'"ppx"\s*:')
MODELS: dict[str, Model | None] = {  # None: neither a pinhole nor one of ours
    "none": "brown",
    "modified_brown_conrady": None,
    "inverse_brown_conrady": "inverse brown",
    "ftheta": None,
    "brown_conrady": "brown",
    "kannala_brandt4": "fisheye",
}


class _Intrinsics(msgspec.Struct):
    width: int
    height: int
    fx: float
    fy: float
    ppx: float
    ppy: float
    model: str | int = "none"
    coeffs: list[float] = []
    depth_scale: float | None = None  # metres a step


def read_realsense(file: "InputFile", info: ImageInfo | None) -> Lens:
    """Camera of the fields of `rs2_intrinsics`, with the device's depth_scale in metres a step.

    Source: librealsense, rs_types.h, `rs2_intrinsics` and `rs2_distortion`.
    Raises: InputError for a distortion model that is none of Brown, its inverse, or fisheye.
    """
    found = decode_json(file, _Intrinsics)
    refuse_unread_terms(decode_json(file, dict[str, object]), _Intrinsics)
    name = _model_name(found.model)
    model = MODELS[name]
    if model is None and any(found.coeffs):
        raise InputError(
            f"camera: distortion: expected brown_conrady, inverse_brown_conrady or "
            f"kannala_brandt4, found {name}"
        )
    coefficients = found.coeffs[:4] if model == "fisheye" else found.coeffs
    return lens_of(
        intrinsic_matrix(found.fx, found.fy, found.ppx, found.ppy),
        (found.width, found.height),
        info,
        distortion=distortion_of(coefficients, model or "brown"),
        depth_scale=None if found.depth_scale is None else 1000 * found.depth_scale,
    )


def _model_name(model: str | int) -> str:
    names = list(MODELS)
    if isinstance(model, int):
        name = names[model] if 0 <= model < len(names) else str(model)
    else:
        name = model.lower().rpartition(".")[2].replace(" ", "_").replace("-", "_")
    if name not in MODELS:
        raise InputError(f"camera: model: expected one of {', '.join(names)}, found {model!r}")
    return name


FORMAT = CameraFormat(
    name="RealSense",
    suffixes=(".json",),
    summary="`fx`, `fy`, `ppx`, `ppy`, `width`, `height`, px, `model`, `coeffs`, and "
    "`depth_scale`, metres a step",
    tested_with="librealsense rs_types.h",
    sniff=lambda head: _KEY.search(head) is not None,
    read=read_realsense,
)
