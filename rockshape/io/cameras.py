"""Camera files: JSON with fx, fy, cx, cy, width and height."""

from pathlib import Path

import msgspec

from rockshape.camera import Camera
from rockshape.errors import InputError
from rockshape.io.files import read_bytes


def read_camera(path: Path | str) -> Camera:
    """Intrinsics from JSON; other keys are passed over, so BOP's camera.json can be read.

    Raises InputError that names the key that is missing or wrong.
    """
    path = Path(path)
    data = read_bytes(path, what="a camera (JSON with fx, fy, cx, cy, width, height)")
    try:
        return msgspec.json.decode(data, type=Camera)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise InputError(
            f"{path}: expected JSON with fx, fy, cx, cy, width, height, found: {error}"
        ) from None
