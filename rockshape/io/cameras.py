"""Camera files: JSON with fx, fy, cx, cy, width and height."""

from pathlib import Path

import msgspec

from rockshape.camera.camera import Camera
from rockshape.errors import InputError
from rockshape.io.files import read_bytes


class _Lens(msgspec.Struct):
    """What a camera file says of its lens."""

    distortion: list[float] | None = None  # OpenCV's coefficients


def read_camera(path: Path | str) -> Camera:
    """Intrinsics from JSON; other keys are passed over, so BOP's camera.json can be read.

    Raises InputError that names the key that is missing or wrong, and for a lens that bends rays:
    its picture, range and labels must be straightened first.
    """
    path = Path(path)
    data = read_bytes(path, what="a camera (JSON with fx, fy, cx, cy, width, height)")
    try:
        camera = msgspec.json.decode(data, type=Camera)
        lens = msgspec.json.decode(data, type=_Lens)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise InputError(
            f"{path}: expected JSON with fx, fy, cx, cy, width, height, found: {error}"
        ) from None
    if any(lens.distortion or ()):
        raise InputError(
            f"{path}: distortion: expected a pinhole's picture, straightened with its range and "
            f"labels, found {lens.distortion}"
        )
    return camera
