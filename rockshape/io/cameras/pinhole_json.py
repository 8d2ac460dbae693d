"""Pinhole intrinsics in JSON, as BOP's camera.json has them."""

from typing import TYPE_CHECKING

import msgspec

from rockshape.camera.camera import as_camera
from rockshape.camera.lens import DisparityScale, Lens
from rockshape.errors import InputError
from rockshape.io.decoding.intrinsics import (
    decode_json,
    distortion_of,
    intrinsic_matrix,
    lens_of,
    refuse_unread_terms,
)
from rockshape.io.format import CameraFormat, ImageInfo

if TYPE_CHECKING:
    from rockshape.io.files import InputFile


class _Intrinsics(msgspec.Struct):
    fx: float
    fy: float
    cx: float
    cy: float
    width: int | None = None
    height: int | None = None
    depth_scale: float | None = None
    depth_scale_m: float | None = None
    skew: float = 0.0
    distortion: list[float] | None = None  # OpenCV's coefficients
    baseline_m: float | None = None
    disparity_offset: float = 0.0  # px
    disparity_scale: float | None = None  # px a step
    k1: float = 0.0  # OpenCV's coefficients by name, in place of distortion
    k2: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    k3: float = 0.0
    k4: float = 0.0
    k5: float = 0.0
    k6: float = 0.0

    @property
    def terms(self) -> list[float]:
        """OpenCV's coefficients, of `distortion` or by name."""
        named = [self.k1, self.k2, self.p1, self.p2, self.k3, self.k4, self.k5, self.k6]
        if self.distortion is not None and any(named):
            raise InputError("camera: distortion: expected it alone, found k1, k2, ... beside it")
        return named if self.distortion is None else self.distortion


def read_pinhole(file: "InputFile", info: ImageInfo | None) -> Lens:
    """Camera of a JSON object with fx, fy, cx, cy and, if not told by the image, width and height.

    Other keys are ignored, but for those that tell of distortion.
    Raises: InputError: names the key that is missing or wrong.
    """
    found = decode_json(file, _Intrinsics)
    refuse_unread_terms(decode_json(file, dict[str, object]), _Intrinsics)
    k = intrinsic_matrix(found.fx, found.fy, found.cx, found.cy)
    k[0][1] = found.skew
    shape = None if info is None else info.shape
    distortion = distortion_of(found.terms)
    disparity = None
    if found.baseline_m is not None:
        disparity = DisparityScale(found.baseline_m, found.disparity_offset, found.disparity_scale)
    elif found.disparity_scale is not None or found.disparity_offset:
        raise InputError("camera: baseline_m: expected a number beside disparity_scale, found none")
    found.skew, found.distortion = 0.0, None
    pinhole = as_camera(found, shape=shape)
    return lens_of(
        k,
        (found.width, found.height),
        info,
        distortion=distortion,
        depth_scale=pinhole.depth_scale,
        disparity=disparity,
    )


FORMAT = CameraFormat(
    name="pinhole JSON",
    suffixes=(".json",),
    summary="object with `fx`, `fy`, `cx`, `cy`, px; `width`, `height`, px, unless the image's; "
    "`depth_scale`, mm a step of integer range, or `depth_scale_m`, metres a step; `skew`, px; "
    "`distortion`, OpenCV's coefficients, or `k1`, `k2`, `p1`, `p2`, `k3` to `k6`; `baseline_m`, "
    "`disparity_offset`, px, and `disparity_scale`, px a step, for disparity",
    tested_with="Python json",
    read=read_pinhole,
)
