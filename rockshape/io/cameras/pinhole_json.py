"""Pinhole intrinsics in JSON, as BOP's camera.json has them."""

from typing import TYPE_CHECKING

import msgspec

from rockshape.camera.camera import Camera, as_camera
from rockshape.errors import InputError
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
    distortion: list[float] | None = None  # OpenCV's coefficients


def read_pinhole(file: "InputFile", info: ImageInfo | None) -> Camera:
    """Camera of a JSON object with fx, fy, cx, cy and, if not told by the image, width and height.

    Other keys are ignored.

    Raises:
        InputError: names the key that is missing or wrong; or the lens distorts, so that image,
            range and labels must be undistorted first.
    """
    try:
        found = msgspec.json.decode(file.data, type=_Intrinsics)
        return as_camera(found, shape=None if info is None else info.shape)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise InputError(
            f"{file.path}: expected JSON with fx, fy, cx, cy, width, height, found: {error}"
        ) from None
    except InputError as error:
        reason = str(error).removeprefix("camera: ")
        raise InputError(f"{file.path}: {reason}") from None


FORMAT = CameraFormat(
    name="pinhole JSON",
    suffixes=(".json",),
    summary="object with `fx`, `fy`, `cx`, `cy`, px; `width`, `height`, px, unless the image's; "
    "`depth_scale`, mm a step of integer range, or `depth_scale_m`, metres a step",
    read=read_pinhole,
)
