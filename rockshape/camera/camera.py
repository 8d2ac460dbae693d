"""Pinhole camera model: projection and unprojection.

Frame: x right, y down, z forward; whole pixel coordinates are pixel centres, (0, 0) the centre of
the upper-left pixel.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.lens_terms import lens_term
from rockshape.errors import InputError

INTRINSICS = ("fx", "fy", "cx", "cy")
MAX_NUMBER = 1e9  # of px or mm; what is larger is a mistake


@runtime_checkable
class PinholeLike(Protocol):
    """Any object with the intrinsics of a pinhole camera, px.

    It may have `width` and `height`, px, `depth_scale`, mm a step of integer range, or
    `depth_scale_m`, metres a step, and `distortion`, coefficients that must all be zero.
    """

    @property
    def fx(self) -> float:
        """Focal length along the rows, px."""

    @property
    def fy(self) -> float:
        """Focal length along the columns, px."""

    @property
    def cx(self) -> float:
        """Column of the principal point, px."""

    @property
    def cy(self) -> float:
        """Row of the principal point, px."""


CameraLike = PinholeLike | Mapping[str, Any]
"""A camera, or a mapping with the same keys."""


@dataclass(frozen=True)
class Camera:
    """Intrinsics of a pinhole camera without distortion.

    Raises: InputError where a focal length or a side is not positive, the principal point not
    finite, or a number too large to be meant.
    """

    fx: float  # px
    fy: float  # px
    cx: float  # px, of the principal point
    cy: float  # px
    width: int  # px
    height: int  # px
    depth_scale: float | None = None  # mm for one unit of a 16-bit depth image, as in BOP

    def __post_init__(self) -> None:
        for name in ("cx", "cy"):
            if not np.abs(getattr(self, name)) <= MAX_NUMBER:
                raise InputError(
                    f"camera: {name}: expected a finite number, found {getattr(self, name)}"
                )
        for name in ("fx", "fy", "width", "height", "depth_scale"):
            value = getattr(self, name)
            if value is not None and not (np.isfinite(value) and value > 0):
                raise InputError(f"camera: {name}: expected a positive number, found {value}")
            if value is not None and value > MAX_NUMBER:
                raise InputError(f"camera: {name}: expected at most {MAX_NUMBER:g}, found {value}")

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the camera's images."""
        return self.height, self.width

    def unproject(self, depth_m: NDArray[np.floating]) -> NDArray[np.float64]:
        """Point at each pixel: X = Z (u - cx)/fx, Y = Z (v - cy)/fy.

        depth_m is (rows, cols) z-depth, NaN where nothing was measured; the result is
        (rows, cols, 3) in the camera frame, metres.
        Raises: InputError where the depth is not of the camera's shape.
        """
        if depth_m.shape != self.shape:
            raise InputError(
                f"depth_m: expected {self.shape} as the camera has, found {depth_m.shape}"
            )
        depth_m = np.asarray(depth_m, dtype=np.float64)
        x = (np.arange(self.width) - self.cx) / self.fx
        y = (np.arange(self.height) - self.cy) / self.fy
        return np.stack([depth_m * x, depth_m * y[:, None], depth_m], axis=-1)

    def project(self, points_m: NDArray[np.floating]) -> NDArray[np.float64]:
        """Pixel coordinates (..., 2) as (x, y) of points (..., 3) in the camera frame."""
        depth = points_m[..., 2]
        return np.stack(
            [
                self.fx * points_m[..., 0] / depth + self.cx,
                self.fy * points_m[..., 1] / depth + self.cy,
            ],
            axis=-1,
        )


def camera_object(like: object) -> object:
    """Object with the attributes of a mapping; anything else as it is."""
    if isinstance(like, Mapping):
        return SimpleNamespace(**{str(name): value for name, value in like.items()})
    return like


def as_camera(like: object, *, shape: tuple[int, ...] | None = None) -> Camera:
    """Camera of any object or mapping with fx, fy, cx and cy, see `PinholeLike`.

    shape, the image's (rows, cols, ...), stands in where the object has no width and height.

    Raises:
        InputError: an intrinsic is missing or no number; the size is told by neither; or the lens
            distorts, so that image, range and labels must be undistorted first.
    """
    if isinstance(like, Camera):
        return like
    kind, like = type(like).__name__, camera_object(like)
    missing = [name for name in INTRINSICS if getattr(like, name, None) is None]
    if missing:
        raise InputError(
            f"camera: expected an object or a mapping with fx, fy, cx, cy, "
            f"found {kind} without {', '.join(missing)}"
        )
    distortion = getattr(like, "distortion", None)
    if distortion is not None and np.any(np.asarray(distortion) != 0):
        raise InputError(
            f"camera: distortion: expected a pinhole camera, its image, range and labels "
            f"undistorted, found {distortion}"
        )
    skew = getattr(like, "skew", None)
    if skew:
        raise InputError(f"camera: skew: expected none, found {skew}")
    unread = lens_term(getattr(like, "__dict__", {}), ("distortion", "skew"))
    if unread is not None:
        raise InputError(f"camera: expected a pinhole camera without distortion, found {unread}")
    height, width = getattr(like, "height", None), getattr(like, "width", None)
    if height is None and width is None and shape is not None:
        height, width = shape[:2]
    fx, fy, cx, cy = (_number(name, getattr(like, name)) for name in INTRINSICS)
    return Camera(
        fx=fx,
        fy=fy,
        cx=cx,
        cy=cy,
        width=_pixels("width", width),
        height=_pixels("height", height),
        depth_scale=_depth_scale(like),
    )


def _depth_scale(like: object) -> float | None:
    """Millimetres a step of integer range, of depth_scale or depth_scale_m.

    Raises: InputError where the two differ.
    """
    mm, metres = getattr(like, "depth_scale", None), getattr(like, "depth_scale_m", None)
    steps = [_number("depth_scale", mm)] if mm is not None else []
    steps += [1000 * _number("depth_scale_m", metres)] if metres is not None else []
    if len(steps) == 2 and abs(steps[1] - steps[0]) > 1e-6 * abs(steps[1]):
        raise InputError(
            f"camera: depth_scale: expected mm a step, as depth_scale_m {metres} m is, found {mm}"
        )
    return steps[0] if steps else None


def _number(name: str, value: object) -> float:
    if isinstance(value, (int, float, np.number)) and not isinstance(value, bool):
        try:
            return float(value)
        except OverflowError:
            return np.inf
    raise InputError(f"camera: {name}: expected a number, found {value!r}")


def _pixels(name: str, value: object) -> int:
    if value is None:
        raise InputError(f"camera: {name}: expected the image's {name}, px, found none")
    number = _number(name, value)
    if not number.is_integer():
        raise InputError(f"camera: {name}: expected a whole number, found {value!r}")
    return int(number)
