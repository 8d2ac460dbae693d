"""COLMAP's cameras.txt."""

from typing import TYPE_CHECKING, NamedTuple

from rockshape.camera.lens import Lens
from rockshape.errors import InputError, unknown_name
from rockshape.io.decoding.intrinsics import (
    CORNER_ORIGIN,
    Model,
    chosen_view,
    distortion_of,
    intrinsic_matrix,
    lens_of,
    text_of,
)
from rockshape.io.format import CameraFormat, ImageInfo

if TYPE_CHECKING:
    from rockshape.io.files import InputFile


class _Model(NamedTuple):
    focal_lengths: int
    terms: int  # after the focal lengths and the principal point
    kind: Model = "brown"


MODELS = {
    "SIMPLE_PINHOLE": _Model(1, 0),
    "PINHOLE": _Model(2, 0),
    "SIMPLE_RADIAL": _Model(1, 1),
    "RADIAL": _Model(1, 2),
    "OPENCV": _Model(2, 4),
    "FULL_OPENCV": _Model(2, 8),
    "OPENCV_FISHEYE": _Model(2, 4, "fisheye"),
    "SIMPLE_RADIAL_FISHEYE": _Model(1, 1, "fisheye"),
    "RADIAL_FISHEYE": _Model(1, 2, "fisheye"),
}


def read_colmap(file: "InputFile", info: ImageInfo | None) -> Lens:
    """Camera of a line `CAMERA_ID MODEL WIDTH HEIGHT PARAMS...`; of several by --camera-view.

    Source: COLMAP, doc/format.rst and src/colmap/sensor/models.h; the first pixel's corner is
    (0, 0).
    Raises: InputError for a model with other terms than OpenCV's.
    """
    lines = [line.split() for line in text_of(file).decode().splitlines()]
    cameras = {words[0]: words[1:] for words in lines if words and not words[0].startswith("#")}
    same = len({tuple(words) for words in cameras.values()}) == 1
    words = cameras[chosen_view(list(cameras), info, same=same)]
    if len(words) < 3 or words[0] not in MODELS:
        raise unknown_name("camera: model", words[0] if words else "nothing", MODELS)
    model = MODELS[words[0]]
    width, height = int(words[1]), int(words[2])
    values = [float(word) for word in words[3:]]
    if len(values) != model.focal_lengths + 2 + model.terms:
        raise InputError(
            f"camera: {words[0]}: expected {model.focal_lengths + 2 + model.terms} parameters, "
            f"found {len(values)}"
        )
    focal, (cx, cy) = values[: model.focal_lengths], values[model.focal_lengths :][:2]
    return lens_of(
        intrinsic_matrix(focal[0], focal[-1], cx, cy),
        (width, height),
        info,
        distortion=distortion_of(values[model.focal_lengths + 2 :], model.kind),
        origin=CORNER_ORIGIN,
    )


def _is_colmap(head: bytes) -> bool:
    """Whether the first line that is no comment names a model."""
    for line in head.splitlines():
        words = line.split()
        if words and not words[0].startswith(b"#"):
            return len(words) > 4 and words[0].isdigit() and words[1].isupper()
    return False


FORMAT = CameraFormat(
    name="COLMAP",
    suffixes=(".txt",),
    summary="cameras.txt, a line a camera: id, model, width, height, parameters; of several, "
    "`--camera-view` is the id",
    tested_with="COLMAP format.rst",
    sniff=_is_colmap,
    read=read_colmap,
)
