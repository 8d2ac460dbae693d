"""Cameras of the numbers that files give: intrinsic matrices, sizes and distortion coefficients."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeVar

import msgspec
import numpy as np
from numpy.typing import ArrayLike

from rockshape.camera.camera import Camera
from rockshape.camera.distortion import (
    BrownConrady,
    Distortion,
    Fisheye,
    InverseBrownConrady,
)
from rockshape.camera.lens import DisparityScale, Lens
from rockshape.camera.lens_terms import lens_term
from rockshape.errors import InputError
from rockshape.io.format import ImageInfo

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

T = TypeVar("T")
Model = Literal["brown", "inverse brown", "fisheye"]
LENGTHS = (4, 5, 8, 12, 14)  # of OpenCV's coefficients
CORNER_ORIGIN = 0.5  # px, of the first pixel's centre where its corner is (0, 0)
RESCALED = 1.3  # ratio of sizes beyond which a principal point is that of an image of another size
SAME_PROPORTIONS = 0.1  # within which its shares of width and height are the same
MAX_TEXT = 2**22  # bytes of a camera file


def decode_json(file: "InputFile", record: type[T]) -> T:
    """Record of a JSON file. Raises: InputError that names the key that is missing or wrong."""
    try:
        return msgspec.json.decode(text_of(file), type=record)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise file.refusal(str(error)) from None


def refuse_unread_terms(camera: Mapping[str, object], record: type[msgspec.Struct]) -> None:
    """Hold an object of JSON to the lens terms that a record has.

    Raises: InputError for distortion or skew under another name, which would be ignored.
    """
    unread = lens_term(camera, record.__struct_encode_fields__)
    if unread is not None:
        raise InputError(
            f"camera: expected no lens terms but those of this format (`rockshape formats`), "
            f"found {unread}"
        )


def text_of(file: "InputFile") -> bytes:
    """Content of a text file without a byte order mark. Raises: InputError for 4 MB and more."""
    if len(file.data) > MAX_TEXT:
        raise file.refusal(f"a file of {len(file.data)} bytes")
    return file.data.removeprefix(b"\xef\xbb\xbf")


def matrix(values: ArrayLike, shape: tuple[int, int], name: str) -> np.ndarray:
    """Matrix of a shape from its rows or its values in order of rows.

    Raises: InputError for another number of values and what is not finite.
    """
    found = np.asarray(values, dtype=np.float64)
    if found.size != shape[0] * shape[1] or not np.isfinite(found).all():
        raise InputError(
            f"camera: {name}: expected {shape[0]} x {shape[1]} finite numbers, found {found.shape}"
        )
    return found.reshape(shape)


def lens_of(
    intrinsics: ArrayLike,
    size: tuple[int | None, int | None],
    info: ImageInfo | None,
    *,
    distortion: Distortion | None = None,
    depth_scale: float | None = None,
    disparity: DisparityScale | None = None,
    origin: float = 0.0,
) -> Lens:
    """Lens of an intrinsic matrix (3, 3) and a size (width, height), else the image's.

    depth_scale is mm a step; origin is where the first pixel's centre lies, px.
    Raises: InputError for a matrix that is none, and numbers that no camera has.
    """
    k = matrix(intrinsics, (3, 3), "intrinsic matrix")
    if k[1, 0] or k[2, 0] or k[2, 1] or k[2, 2] != 1:
        raise InputError(
            f"camera: intrinsic matrix: expected [fx s cx; 0 fy cy; 0 0 1], found {k.tolist()}"
        )
    width, height = size
    if width is None and height is None and info is not None:
        height, width = info.shape
        _check_middle(float(k[0, 2]) - origin, float(k[1, 2]) - origin, width, height)
    if width is None or height is None:
        raise InputError("camera: width: expected the image's width and height, px, found none")
    pinhole = Camera(
        fx=float(k[0, 0]),
        fy=float(k[1, 1]),
        cx=float(k[0, 2]) - origin,
        cy=float(k[1, 2]) - origin,
        width=width,
        height=height,
        depth_scale=depth_scale,
    )
    return Lens(pinhole, skew_px=float(k[0, 1]), distortion=distortion, disparity=disparity)


def _check_middle(cx: float, cy: float, width: int, height: int) -> None:
    """Hold a principal point to an image whose size the file does not tell.

    Raises: InputError where it is the middle of an image of other size and the same proportions.
    """
    across, down = (cx + 0.5) / width, (cy + 0.5) / height
    middle = (across + down) / 2
    alike = middle > 0 and abs(across - down) < SAME_PROPORTIONS * middle
    if alike and not 1 / RESCALED < 2 * middle < RESCALED:
        raise InputError(
            f"camera: cx, cy: expected near the middle of {width} x {height} px, found {cx:g}, "
            f"{cy:g}, that of about {2 * middle * width:.0f} x {2 * middle * height:.0f}: "
            f"of the image before it was scaled; give width and height if it is meant"
        )


def intrinsic_matrix(fx: float, fy: float, cx: float, cy: float) -> list[list[float]]:
    """Intrinsic matrix without skew."""
    return [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]


def distortion_of(coefficients: Sequence[float], model: Model = "brown") -> Distortion | None:
    """Distortion of coefficients, `k1 k2 p1 p2 k3 ...` or `k1 k2 k3 k4` of a fisheye.

    None where they bend nothing. Raises: InputError for more coefficients than the model has.
    """
    values = tuple(float(value) for value in coefficients)
    if not np.isfinite(values).all():
        raise InputError(f"camera: distortion: expected finite numbers, found {values}")
    if model == "fisheye":
        if len(values) > 4:
            raise InputError(f"camera: distortion: expected k1 k2 k3 k4, found {len(values)} terms")
        k1, k2, k3, k4 = (*values, 0.0, 0.0, 0.0, 0.0)[:4]
        return Fisheye((k1, k2, k3, k4))  # even of zeros it is no pinhole
    if not any(values):
        return None
    used = len(values)
    while used and not values[used - 1]:
        used -= 1
    length = next((length for length in LENGTHS if length >= used), None)
    if length is None:
        raise InputError(
            f"camera: distortion: expected at most {LENGTHS[-1]} terms, found {len(values)}"
        )
    padded = (*values, *[0.0] * length)[:length]
    return InverseBrownConrady(padded) if model == "inverse brown" else BrownConrady(padded)


def chosen_view(names: Sequence[str], info: ImageInfo | None, *, same: bool = False) -> str:
    """Name of the view that a file of several is to be read for.

    The view that the user names; else the only one, or any where they are the same; else the
    number that the image's name is, `000003.png`.
    Raises: InputError where that leaves the choice open.
    """
    if info is not None and info.view is not None:
        if info.view in names:
            return info.view
        raise InputError(
            f"camera: expected --camera-view to be one of {_few(names)}, found {info.view!r}"
        )
    if not names:
        raise InputError("camera: expected a view, found none")
    if len(names) == 1 or same:
        return names[0]
    stem = Path(info.name).stem if info is not None else ""
    number = str(int(stem)) if stem.isascii() and stem.isdigit() else stem
    if number in names:
        return number
    raise InputError(f"camera: expected --camera-view with one of {_few(names)}, found none")


def _few(names: Sequence[str]) -> str:
    shown = ", ".join(names[:6])
    return f"{shown}, ... {names[-1]}" if len(names) > 6 else shown
