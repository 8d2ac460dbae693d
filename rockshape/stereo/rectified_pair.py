"""Rectification of a stereo pair: two pinholes side by side in place of the cameras it has."""

from dataclasses import dataclass, replace

import cv2
import numpy as np

from rockshape.camera.camera import Camera
from rockshape.camera.lens import DisparityScale, FramePose, Lens, RightCamera
from rockshape.errors import InputError
from rockshape.numerics.arrays import Floats
from rockshape.stereo.block_matching import Bytes

EXACT = 1e-9  # relative, of cameras that are rectified
ROTATION = 1e-3  # by which R Rᵀ may differ from the identity in a file of few digits
MAX_GROWTH = 2  # of a side of the left picture, beyond which a rectified one is cut
JUMP_PX = 1.0  # disparities that differ by more lie on different surfaces
NOWHERE = -1e6  # px


@dataclass(frozen=True, eq=False)
class RectifiedEye:
    """One camera of a rectified pair: the pinhole in place of a lens, both at the same point."""

    pinhole: Camera
    lens: Lens
    rotation: Floats  # (3, 3), of the lens's frame to the pinhole's

    def picture(self, pixels: Bytes) -> Bytes:
        """Picture (rows, cols) that the pinhole takes, of the lens's; its border is repeated."""
        rays = self.pinhole.unproject(np.ones(self.pinhole.shape)) @ self.rotation
        with np.errstate(divide="ignore", invalid="ignore"):
            places = self.lens.project(rays)
        places[~(rays[..., 2] > 0)] = NOWHERE
        x, y = np.moveaxis(np.nan_to_num(places, nan=NOWHERE), -1, 0).astype(np.float32)
        shown = cv2.remap(pixels, x, y, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
        return np.asarray(shown, dtype=np.uint8)

    def rays(self) -> Floats:
        """Directions (rows, cols, 3), z = 1, of the lens's pixels in the pinhole's frame."""
        rays = self.lens.rays() @ self.rotation.T
        rays[~(rays[..., 2] > 0)] = np.nan
        return np.asarray(rays / rays[..., 2:])

    def seen_by_lens(self, disparity: Floats, rays: Floats) -> Floats:
        """Disparity at the lens's pixels, whose rays in the pinhole's frame are given.

        Interpolated, but across an edge that of the nearest pixel.
        """
        places = self.pinhole.project(rays)
        x, y = np.moveaxis(np.nan_to_num(places, nan=NOWHERE), -1, 0).astype(np.float32)
        between, nearest = (
            np.asarray(cv2.remap(disparity, x, y, how, borderValue=np.nan))
            for how in (cv2.INTER_LINEAR, cv2.INTER_NEAREST)
        )
        return np.where(np.abs(between - nearest) <= JUMP_PX, between, nearest)


@dataclass(frozen=True, eq=False)
class RectifiedPair:
    """Rectified stereo pair: equal pinholes, the right one a baseline along the rows."""

    left: RectifiedEye
    right: RectifiedEye
    baseline_m: float

    @property
    def infinity_px(self) -> float:
        """Disparity of what is infinitely far."""
        return self.left.pinhole.cx - self.right.pinhole.cx

    def points(self, disparity: Floats) -> Floats:
        """Points (rows, cols, 3), m, of the left lens's pixels in its frame; NaN without a match.

        disparity is that of the rectified left picture, px: Z = f B / (d - d∞).
        """
        rays = self.left.rays()
        seen = self.left.seen_by_lens(disparity, rays)
        scale = DisparityScale(self.baseline_m, -self.infinity_px)
        depth = scale.depth(seen, fx=self.left.pinhole.fx)
        return np.asarray((rays * depth[..., None]) @ self.left.rotation)


def rectified_pair(lens: Lens) -> RectifiedPair:
    """Rectified pair of a stereo camera.

    Pictures of a camera with a baseline alone are rectified already, and so are those of two
    cameras without distortion, side by side and turned the same way.
    Raises: InputError for a camera of one eye, and where the right camera is not to the right.
    """
    if lens.right is not None:
        return _of_two_cameras(lens, lens.right)
    if lens.disparity is None:
        raise InputError(
            "stereo pair: expected a stereo camera (--camera with baseline_m, with Q, or with M1, "
            "M2, R and T), found a camera of one eye"
        )
    if not lens.is_pinhole:
        raise InputError(
            "stereo pair: expected the camera of rectified pictures beside a baseline, or both "
            "cameras (M1, D1, M2, D2, R, T), found distortion or skew"
        )
    pinhole = lens.pinhole
    right = replace(pinhole, cx=pinhole.cx + lens.disparity.offset_px)
    return RectifiedPair(_straight_eye(pinhole), _straight_eye(right), lens.disparity.baseline_m)


def _straight_eye(pinhole: Camera) -> RectifiedEye:
    return RectifiedEye(pinhole, Lens(pinhole), np.eye(3))


def _of_two_cameras(lens: Lens, right: RightCamera) -> RectifiedPair:
    baseline_m = _baseline(right.pose)
    if _is_rectified(lens, right):
        return RectifiedPair(
            _straight_eye(lens.pinhole), _straight_eye(right.lens.pinhole), baseline_m
        )
    rotation_left, rotation_right, _, shifted = cv2.stereoRectify(
        _matrix(lens.pinhole),
        np.zeros(4),
        _matrix(right.lens.pinhole),
        np.zeros(4),
        (lens.pinhole.width, lens.pinhole.height),
        right.pose.rotation,
        right.pose.translation_m.reshape(3, 1),
    )[:4]
    if not shifted[0, 3] < 0:
        raise InputError(
            f"stereo pair: expected the right camera to the right of the left, T of a negative x, "
            f"found T {right.pose.translation_m.tolist()}"
        )
    rotations = rotation_left.astype(np.float64), rotation_right.astype(np.float64)
    left_pinhole, right_pinhole = _pinholes((lens, right.lens), rotations)
    return RectifiedPair(
        RectifiedEye(left_pinhole, lens, rotations[0]),
        RectifiedEye(right_pinhole, right.lens, rotations[1]),
        baseline_m,
    )


def _baseline(pose: FramePose) -> float:
    """Distance between the cameras, m. Raises: InputError for no rotation or no distance."""
    miss = np.abs(pose.rotation @ pose.rotation.T - np.eye(3)).max()
    if not miss < ROTATION or np.linalg.det(pose.rotation) < 0:
        raise InputError(f"camera: R: expected a rotation, found {pose.rotation.tolist()}")
    baseline_m = float(np.linalg.norm(pose.translation_m))
    if not 0 < baseline_m < np.inf:
        raise InputError("camera: T: expected the way from one camera to the other, found none")
    return baseline_m


def _is_rectified(lens: Lens, right: RightCamera) -> bool:
    """Whether the cameras are pinholes side by side, of equal focal lengths and rows."""
    own, other = lens.pinhole, right.lens.pinhole
    if not (lens.is_pinhole and right.lens.is_pinhole):
        return False
    along = right.pose.translation_m / np.linalg.norm(right.pose.translation_m)
    return bool(
        np.allclose(right.pose.rotation, np.eye(3), atol=EXACT)
        and np.allclose(along, [-1, 0, 0], atol=EXACT)
        and np.allclose([own.fx, own.fy, own.cy], [other.fx, other.fy, other.cy], rtol=EXACT)
    )


def _matrix(pinhole: Camera) -> Floats:
    return np.array([[pinhole.fx, 0, pinhole.cx], [0, pinhole.fy, pinhole.cy], [0, 0, 1.0]])


def _pinholes(lenses: tuple[Lens, Lens], rotations: tuple[Floats, Floats]) -> tuple[Camera, Camera]:
    """Pinholes of the left lens's focal length whose frames hold what each lens sees.

    Their rows are the same, those that the left lens sees.
    """
    pinhole = lenses[0].pinhole
    focal = max(pinhole.fx, pinhole.fy)
    bounds = []
    for lens, rotation in zip(lenses, rotations, strict=True):
        rays = RectifiedEye(lens.pinhole, lens, rotation).rays()
        bounds.append(focal * np.array([np.nanmin(rays, (0, 1)), np.nanmax(rays, (0, 1))])[:, :2])
    (left_low, left_high), (right_low, right_high) = bounds
    most = MAX_GROWTH * np.array([pinhole.width, pinhole.height])
    cols, rows = np.minimum(np.ceil(left_high - left_low) + 1, most)
    cols = min(max(cols, np.ceil(right_high[0] - right_low[0]) + 1), most[0])
    first_row = np.floor(_start(left_low[1], left_high[1], rows))
    left_first, right_first = (
        float(np.floor(_start(low[0], high[0], cols))) for low, high in bounds
    )
    left = Camera(
        fx=focal,
        fy=focal,
        cx=-left_first,
        cy=-float(first_row),
        width=int(cols),
        height=int(rows),
    )
    return left, replace(left, cx=-right_first)


def _start(low: float, high: float, size: float) -> float:
    """First pixel of a frame: where the field begins, or in its middle where it is cut."""
    return low if high - low <= size else (low + high - size) / 2
