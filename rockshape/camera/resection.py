"""Where a camera stood, found from the pixels of a range image and the points seen at them.

A range product may come in a frame that is not the camera's, a lander's for instance. The measures
need to know from where a rock was seen, so the camera is resected: position, attitude and focal
length, with square pixels and the principal point in the middle of the frame.
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from rockshape.camera.camera import Camera

SAMPLE = 2000  # pixels used: enough for 1e-2 px, and quick
MIN_PIXELS = 12  # pixels below which seven unknowns are not worth solving for


@dataclass(frozen=True, eq=False)
class Resection:
    """A camera and its pose: a point p of the range frame is R p + t in the camera frame."""

    camera: Camera
    rotation: NDArray[np.float64]  # (3, 3)
    translation_m: NDArray[np.float64]  # (3,)
    residual_px: float  # median distance between a pixel and its point's projection

    @property
    def centre_m(self) -> NDArray[np.float64]:
        """Position of the camera in the range frame, (3,)."""
        return -self.rotation.T @ self.translation_m

    def to_camera(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (..., 3) of the range frame in the camera frame."""
        return points_m @ self.rotation.T + self.translation_m


def calibrate(points_m: NDArray[np.float64]) -> Resection | None:
    """Find the camera at the origin, looking along z, that saw points_m, (rows, cols, 3).

    The lines u = fx X/Z + cx and v = fy Y/Z + cy through all pixels, by least squares; the
    principal point is free. None where fewer than 12 pixels have a point, or no such camera can
    have seen them.
    """
    rows, cols = points_m.shape[:2]
    row, col, points = _sample(points_m)
    if len(row) < MIN_PIXELS or np.any(points[:, 2] <= 0):
        return None
    across, down = (points[:, :2] / points[:, 2:]).T
    if np.ptp(across) == 0 or np.ptp(down) == 0:
        return None
    (fx, cx), (fy, cy) = np.polyfit(across, col, 1), np.polyfit(down, row, 1)
    if fx <= 0 or fy <= 0:
        return None
    misses = np.hypot(fx * across + cx - col, fy * down + cy - row)
    return Resection(
        camera=Camera(float(fx), float(fy), float(cx), float(cy), cols, rows),
        rotation=np.eye(3),
        translation_m=np.zeros(3),
        residual_px=float(np.median(misses)),
    )


def resect(points_m: NDArray[np.float64]) -> Resection | None:
    """Find the camera that saw points_m, (rows, cols, 3), at its own grid of pixels.

    The start is the direct linear transformation (Abdel-Aziz and Karara 1971); the camera with
    square pixels nearest to it is then refined by least squares on the pixel residuals.
    None where fewer than 12 pixels have a point or no camera explains the grid.
    """
    rows, cols = points_m.shape[:2]
    row, col, points = _sample(points_m)
    if len(row) < MIN_PIXELS:
        return None
    pixels = np.column_stack([col, row]).astype(np.float64)
    middle = np.array([(cols - 1) / 2, (rows - 1) / 2])

    start = _direct_linear(pixels - middle, points)
    if start is None:
        return None

    def residuals(parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        camera_points = _pose(parameters, points)
        depth = np.maximum(camera_points[:, 2], 1e-6)
        seen = np.exp(parameters[6]) * camera_points[:, :2] / depth[:, None]
        return np.asarray((seen - (pixels - middle)).ravel())

    fit = least_squares(residuals, start, method="lm", x_scale="jac")
    rotation = Rotation.from_rotvec(fit.x[:3]).as_matrix()
    focal = float(np.exp(fit.x[6]))
    if not np.isfinite(focal) or np.any(_pose(fit.x, points)[:, 2] <= 0):
        return None
    misses = np.linalg.norm(residuals(fit.x).reshape(-1, 2), axis=1)
    return Resection(
        camera=Camera(focal, focal, float(middle[0]), float(middle[1]), cols, rows),
        rotation=rotation,
        translation_m=fit.x[3:6],
        residual_px=float(np.median(misses)),
    )


def _sample(
    points_m: NDArray[np.float64],
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.float64]]:
    """Rows, columns and points of pixels spread over those that have a point."""
    row, col = np.nonzero(np.isfinite(points_m).all(axis=-1))
    every = max(1, len(row) // SAMPLE)
    row, col = row[::every], col[::every]
    return row, col, points_m[row, col]


def _pose(parameters: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    moved: NDArray[np.float64] = Rotation.from_rotvec(parameters[:3]).apply(points)
    return moved + parameters[3:6]


def _direct_linear(
    pixels: NDArray[np.float64], points: NDArray[np.float64]
) -> NDArray[np.float64] | None:
    """Rotation vector, translation and log focal length from the 3x4 projection matrix."""
    centre = points.mean(axis=0)
    size = float(np.sqrt(((points - centre) ** 2).sum(axis=1).mean()))
    scale = float(np.abs(pixels).max())
    if size == 0 or scale == 0:
        return None
    world = np.column_stack([(points - centre) / size, np.ones(len(points))])
    x, y = (pixels / scale).T
    zero = np.zeros_like(world)
    equations = np.vstack(
        [
            np.hstack([world, zero, -x[:, None] * world]),
            np.hstack([zero, world, -y[:, None] * world]),
        ]
    )
    values, vectors = np.linalg.eigh(equations.T @ equations)
    if not np.isfinite(values).all():
        return None
    projection = vectors[:, 0].reshape(3, 4)
    if np.median(world @ projection[2]) < 0:
        projection = -projection
    try:
        calibration, rotation, *_ = cv2.RQDecomp3x3(projection[:, :3])[1:3]
    except cv2.error:
        return None
    calibration, rotation = np.asarray(calibration), np.asarray(rotation)
    signs = np.diag(np.sign(np.diag(calibration)))
    calibration, rotation = calibration @ signs, signs @ rotation
    if np.linalg.det(rotation) < 0 or np.linalg.matrix_rank(calibration) < 3:
        return None
    translation = np.linalg.solve(calibration, projection[:, 3]) * size - rotation @ centre
    focal = float(np.sqrt(abs(np.linalg.det(calibration[:2, :2])))) / calibration[2, 2] * scale
    vector = Rotation.from_matrix(rotation).as_rotvec()
    return np.concatenate([vector, translation, [np.log(focal)]])
