"""Calibrations that OpenCV's FileStorage wrote, as YAML, JSON or XML."""

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING

import cv2
import numpy as np

from rockshape.camera.lens import DisparityScale, FramePose, Lens, RightCamera
from rockshape.errors import InputError
from rockshape.io.decoding.intrinsics import (
    Model,
    distortion_of,
    intrinsic_matrix,
    lens_of,
    matrix,
    text_of,
)
from rockshape.io.format import CameraFormat, ImageInfo
from rockshape.numerics.arrays import Floats

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

_MARK = re.compile(rb"opencv-matrix|<opencv_storage>")
MATRIX = ("camera_matrix", "cameraMatrix", "Camera_Matrix", "K", "intrinsic_matrix", "mtx")
COEFFICIENTS = (
    "distortion_coefficients",
    "Distortion_Coefficients",
    "distCoeffs",
    "dist_coeffs",
    "dist_coeff",
    "D",
    "dist",
)
WIDTH = ("image_width", "image_Width", "imageWidth", "width")
HEIGHT = ("image_height", "image_Height", "imageHeight", "height")
SIZE = ("image_size", "imageSize", "size")
LEFT, RIGHT = ("M1", "cameraMatrix1", "K1"), ("M2", "cameraMatrix2", "K2")
LEFT_TERMS, RIGHT_TERMS = ("D1", "distCoeffs1"), ("D2", "distCoeffs2")
MAX_NUMBERS = 1000
FISHEYE = ("fisheye_model", "fisheye")


class _Storage:
    """Top-level entries of a FileStorage."""

    def __init__(self, text: str) -> None:
        self._storage = cv2.FileStorage(text, cv2.FILE_STORAGE_READ | cv2.FILE_STORAGE_MEMORY)

    def _node(self, names: Iterable[str]) -> cv2.FileNode | None:
        nodes = (self._storage.getNode(name) for name in names)
        return next((node for node in nodes if not node.empty()), None)

    def numbers(self, *names: str) -> Floats | None:
        """Matrix or list of numbers of the first name that there is.

        Elements are read one by one: OpenCV's own reader of matrices writes beyond them where a
        damaged file declares another size than it has.
        """
        node = self._node(names)
        if node is None:
            return None
        listed = node.getNode("data") if node.isMap() else node
        if not listed.isSeq() or listed.size() > MAX_NUMBERS:
            raise ValueError(f"no numbers of {names[0]}")
        found = np.array([_number(listed.at(index)) for index in range(listed.size())])
        if not node.isMap():
            return found
        rows, cols = (int(_number(node.getNode(side))) for side in ("rows", "cols"))
        return found.reshape(max(rows, 0), max(cols, 0))

    def whole(self, *names: str) -> int | None:
        """Whole number of the first name that there is."""
        node = self._node(names)
        return None if node is None or not node.isInt() else int(node.real())


def _number(node: cv2.FileNode) -> float:
    if not (node.isInt() or node.isReal()):
        raise ValueError("a matrix with other than numbers")
    return float(node.real())


def read_opencv(file: "InputFile", info: ImageInfo | None) -> Lens:
    """Camera with its distortion, the two of a stereo pair with R and T, or that of Q alone.

    Source: OpenCV, samples camera_calibration, stereo_calib and fisheye; `stereoRectify` for Q.
    Raises: InputError where none of these is there.
    """
    storage = _Storage(text_of(file).decode())
    width, height = _size(storage)
    model: Model = "fisheye" if storage.whole(*FISHEYE) else "brown"
    k = storage.numbers(*MATRIX, *LEFT)
    q = storage.numbers("Q")
    if k is None and q is not None:
        return _rectified(q, (width, height), info)
    projections = storage.numbers("P1"), storage.numbers("P2")
    if k is None and projections[0] is not None and projections[1] is not None:
        return _projected(projections[0], projections[1], (width, height), info)
    if k is None:
        raise file.refusal("no camera_matrix, M1, Q, or P1 and P2")
    terms = storage.numbers(*COEFFICIENTS, *LEFT_TERMS)
    distortion = None if terms is None else distortion_of(terms.ravel().tolist(), model)
    left = lens_of(k, (width, height), info, distortion=distortion)
    return Lens(
        left.pinhole,
        skew_px=left.skew_px,
        distortion=distortion,
        right=_right(storage, left, info),
    )


def _size(storage: _Storage) -> tuple[int | None, int | None]:
    pair = storage.numbers(*SIZE)
    if pair is not None and pair.size == 2:
        return int(pair.flat[0]), int(pair.flat[1])
    return storage.whole(*WIDTH), storage.whole(*HEIGHT)


def _rectified(q: Floats, size: tuple[int | None, int | None], info: ImageInfo | None) -> Lens:
    """Left camera of a rectified pair of its disparity-to-depth matrix."""
    q = matrix(q, (4, 4), "Q")
    if not q[3, 2]:
        raise InputError("camera: Q: expected -1/Tx in its last row, found 0")
    baseline = abs(1 / q[3, 2])
    k = intrinsic_matrix(q[2, 3], q[2, 3], -q[0, 3], -q[1, 3])
    scale = DisparityScale(float(baseline), float(q[3, 3] / abs(q[3, 2])))
    return lens_of(k, size, info, disparity=scale)


def _projected(
    left: Floats, right: Floats, size: tuple[int | None, int | None], info: ImageInfo | None
) -> Lens:
    """Left camera of a rectified pair of both projection matrices, P2 = K [I | -B x]."""
    left, right = matrix(left, (3, 4), "P1"), matrix(right, (3, 4), "P2")
    if not right[0, 3] < 0 or right[1, 3] or not right[0, 0] > 0:
        raise InputError(
            f"camera: P2: expected a right camera beside the left, -f B and 0 in its last column, "
            f"found {right[:2, 3].tolist()}"
        )
    scale = DisparityScale(float(-right[0, 3] / right[0, 0]), float(right[0, 2] - left[0, 2]))
    return lens_of(left[:, :3], size, info, disparity=scale)


def _right(storage: _Storage, left: Lens, info: ImageInfo | None) -> RightCamera | None:
    k = storage.numbers(*RIGHT)
    rotation, translation = storage.numbers("R"), storage.numbers("T")
    if k is None or rotation is None or translation is None:
        return None
    terms = storage.numbers(*RIGHT_TERMS)
    size = left.pinhole.width, left.pinhole.height
    distortion = None if terms is None else distortion_of(terms.ravel().tolist())
    pose = FramePose(matrix(rotation, (3, 3), "R"), matrix(translation, (3, 1), "T").ravel())
    return RightCamera(lens_of(k, size, info, distortion=distortion), pose)


FORMAT = CameraFormat(
    name="OpenCV",
    suffixes=(".yml", ".yaml", ".json", ".xml"),
    summary="FileStorage with `camera_matrix` and `distortion_coefficients`; `M1`, `D1`, `M2`, "
    "`D2`, `R`, `T` of a stereo pair; or `Q`, or `P1` and `P2`, of a rectified one",
    tested_with="OpenCV",
    sniff=lambda head: _MARK.search(head) is not None,
    read=read_opencv,
)
