"""Camera as its file describes it: pinhole, skew, distortion, pose and stereo partner."""

from dataclasses import dataclass

import numpy as np

from rockshape.camera.camera import Camera
from rockshape.camera.distortion import Distortion
from rockshape.errors import InputError
from rockshape.numerics.arrays import Floats

SQUARE = 0.005  # relative difference of focal lengths up to which pixels are square


@dataclass(frozen=True, eq=False)
class FramePose:
    """A point p of another frame is R p + t in the camera's."""

    rotation: Floats  # (3, 3)
    translation_m: Floats  # (3,)

    def to_camera(self, points_m: Floats) -> Floats:
        """Points (..., 3) in the camera's frame."""
        return points_m @ self.rotation.T + self.translation_m


@dataclass(frozen=True)
class DisparityScale:
    """Disparity of a rectified pair: Z = f B / (step d + offset), with f of the left camera."""

    baseline_m: float
    offset_px: float = 0.0  # of the principal points, right less left
    step_px: float | None = None  # px a step of integer disparity

    def __post_init__(self) -> None:
        for name in ("baseline_m", "step_px"):
            value = getattr(self, name)
            if value is not None and not 0 < value < np.inf:
                raise InputError(f"camera: {name}: expected a positive number, found {value}")
        if not np.isfinite(self.offset_px):
            raise InputError(f"camera: offset_px: expected a finite number, found {self.offset_px}")

    def depth(self, disparity: Floats, *, fx: float) -> Floats:
        """Z-depth of disparity in px, in the baseline's unit; NaN where nothing is that far."""
        known = disparity + self.offset_px
        return np.asarray(fx * self.baseline_m / np.where(known > 0, known, np.nan))


@dataclass(frozen=True, eq=False)
class Lens:
    """Camera of a file: a pinhole behind a lens, and where it stood in a frame of range.

    Pixels are u = fx x + skew y + cx and v = fy y + cy of the distorted point (x, y).
    """

    pinhole: Camera
    skew_px: float = 0.0
    distortion: Distortion | None = None
    pose: FramePose | None = None  # of the frame that the file names, a rover's
    disparity: DisparityScale | None = None
    right: "RightCamera | None" = None  # of a stereo pair

    def __post_init__(self) -> None:
        if not np.isfinite(self.skew_px):
            raise InputError(f"camera: skew: expected a finite number, found {self.skew_px}")

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the camera's images."""
        return self.pinhole.shape

    @property
    def depth_scale(self) -> float | None:
        """Millimetres a step of integer range."""
        return self.pinhole.depth_scale

    @property
    def is_pinhole(self) -> bool:
        """Whether rays are those of a pinhole camera without skew."""
        return self.skew_px == 0 and self.distortion is None

    @property
    def has_square_pixels(self) -> bool:
        """Whether an image keeps the shape of what it shows: a pinhole of equal focal lengths."""
        return self.is_pinhole and has_square_pixels(self.pinhole)

    def rays(self) -> Floats:
        """Directions (rows, cols, 3), z = 1, of the pixels; NaN where the lens shows nothing."""
        rows, cols = self.shape
        v, u = np.mgrid[:rows, :cols].reshape(2, -1).astype(np.float64)
        return self.rays_at(np.column_stack([u, v])).reshape(rows, cols, 3)

    def rays_at(self, pixels: Floats) -> Floats:
        """Directions (n, 3), z = 1, of pixels (n, 2) as (x, y); NaN where nothing is shown."""
        y = (pixels[:, 1] - self.pinhole.cy) / self.pinhole.fy
        x = (pixels[:, 0] - self.pinhole.cx - self.skew_px * y) / self.pinhole.fx
        plane = np.column_stack([x, y])
        if self.distortion is not None:
            plane = self.distortion.undistort(plane)
        return np.column_stack([plane, np.ones(len(plane))])

    def project(self, points_m: Floats) -> Floats:
        """Pixel coordinates (..., 2) as (x, y) of points (..., 3) in the camera's frame."""
        flat = points_m.reshape(-1, 3)
        plane = flat[:, :2] / flat[:, 2:]
        if self.distortion is not None:
            plane = self.distortion.distort(plane)
        x, y = plane.T
        pixels = [
            self.pinhole.fx * x + self.skew_px * y + self.pinhole.cx,
            self.pinhole.fy * y + self.pinhole.cy,
        ]
        return np.stack(pixels, axis=-1).reshape(*points_m.shape[:-1], 2)


@dataclass(frozen=True, eq=False)
class RightCamera:
    """Right camera of a stereo pair; the pose brings the left camera's points to its frame."""

    lens: Lens
    pose: FramePose


def has_square_pixels(camera: Camera) -> bool:
    """Whether the focal lengths of a pinhole camera are equal to 0.5 %."""
    return abs(camera.fx - camera.fy) <= SQUARE * max(camera.fx, camera.fy)


def as_lens(camera: "Camera | Lens | None") -> Lens | None:
    """Lens of a camera without distortion; a lens as it is."""
    return Lens(camera) if isinstance(camera, Camera) else camera
