"""ROS's camera_info in YAML."""

import re
from typing import TYPE_CHECKING

import msgspec

from rockshape.camera.lens import DisparityScale, Lens
from rockshape.errors import InputError, one_line
from rockshape.io.decoding.intrinsics import Model, distortion_of, lens_of, matrix, text_of
from rockshape.io.format import CameraFormat, ImageInfo

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

_KEY = re.compile(rb"^\s*(image_width|camera_matrix|distortion_model|[Kk])\s*:", re.MULTILINE)
MODELS: dict[str, Model] = {
    "": "brown",
    "plumb_bob": "brown",
    "rational_polynomial": "brown",
    "equidistant": "fisheye",
    "fisheye": "fisheye",
}


class _Matrix(msgspec.Struct):
    data: list[float]


class _Region(msgspec.Struct, frozen=True):
    x_offset: int = 0
    y_offset: int = 0
    width: int = 0
    height: int = 0


class _CameraInfo(msgspec.Struct):
    """Fields of a calibration file, and those of the message as it is printed."""

    image_width: int | None = None
    image_height: int | None = None
    camera_matrix: _Matrix | None = None
    distortion_coefficients: _Matrix | None = None
    projection_matrix: _Matrix | None = None
    width: int | None = None
    height: int | None = None
    K: list[float] | None = None
    D: list[float] | None = None
    P: list[float] | None = None
    k: list[float] | None = None
    d: list[float] | None = None
    p: list[float] | None = None
    distortion_model: str = "plumb_bob"
    binning_x: int = 0
    binning_y: int = 0
    roi: _Region = _Region()


def read_camera_info(file: "InputFile", info: ImageInfo | None) -> Lens:
    """Camera of the raw image, with its baseline where the projection matrix has one.

    Source: ROS, sensor_msgs/CameraInfo; camera_calibration_parsers for the names in files.
    Raises: InputError for an unknown distortion model, a region of interest and binning.
    """
    import yaml  # noqa: PLC0415 - other formats do without

    try:
        found = msgspec.convert(yaml.safe_load(text_of(file)), _CameraInfo)
    except (msgspec.ValidationError, yaml.YAMLError) as error:
        raise file.refusal(one_line(str(error))) from None
    k = found.camera_matrix.data if found.camera_matrix else found.K or found.k
    terms = found.distortion_coefficients
    d = terms.data if terms else found.D or found.d or []
    if k is None:
        raise file.refusal("no camera_matrix and no K")
    if found.distortion_model not in MODELS:
        raise InputError(
            f"camera: distortion_model: expected {', '.join(filter(None, MODELS))}, "
            f"found {found.distortion_model!r}"
        )
    width, height = found.image_width or found.width, found.image_height or found.height
    region = found.roi
    if max(found.binning_x, found.binning_y) > 1 or (
        (region.width or region.height) and (region.width, region.height) != (width, height)
    ):
        raise InputError("camera: expected the whole image without binning, found binning or roi")
    return lens_of(
        k,
        (width, height),
        info,
        distortion=distortion_of(d, MODELS[found.distortion_model]) if any(d) else None,
        disparity=_baseline(found),
    )


def _baseline(found: _CameraInfo) -> DisparityScale | None:
    """Baseline of a projection matrix, whose fourth column is -fx B in the right camera."""
    values = found.projection_matrix.data if found.projection_matrix else found.P or found.p
    if values is None:
        return None
    projection = matrix(values, (3, 4), "projection_matrix")
    if not projection[0, 3] or not projection[0, 0]:
        return None
    return DisparityScale(abs(float(projection[0, 3] / projection[0, 0])))


FORMAT = CameraFormat(
    name="ROS camera_info",
    suffixes=(".yaml", ".yml"),
    summary="YAML with `image_width`, `image_height`, `camera_matrix`, `distortion_model`, "
    "`distortion_coefficients`; or the printed message",
    tested_with="sensor_msgs/CameraInfo, camera_calibration_parsers",
    sniff=lambda head: _KEY.search(head) is not None and b"opencv-matrix" not in head,
    read=read_camera_info,
)
