"""Pose of a camera in the world."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rockshape.errors import InputError
from rockshape.numerics.array_argument import array_argument

ROTATION_ERROR = 1e-3  # of R Rᵀ against the identity, that of numbers printed with four digits


@dataclass(frozen=True, eq=False)
class CameraPose:
    """Pose of a camera: p_world = camera_to_world @ p_camera + position_m."""

    camera_to_world: NDArray[np.float64]  # (3, 3), a rotation
    position_m: NDArray[np.float64]  # (3,)

    @classmethod
    def from_world_to_camera(
        cls, rotation: NDArray[np.float64], translation_m: NDArray[np.float64]
    ) -> Self:
        """Pose of the inverse motion, p_camera = rotation @ p_world + translation_m."""
        return cls(rotation.T, -rotation.T @ translation_m)

    def to_world(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (..., 3) of the camera frame in the world."""
        return np.asarray(points_m @ self.camera_to_world.T + self.position_m)


PoseLike = CameraPose | ArrayLike


def pose_argument(name: str, value: PoseLike) -> CameraPose:
    """Pose of an argument: a CameraPose, or its matrix (4, 4) or (3, 4) from camera to world.

    Raises: InputError for anything else, and for a matrix whose first three columns do not rotate.
    """
    if isinstance(value, CameraPose):
        matrix = np.column_stack([value.camera_to_world, value.position_m])
    else:
        matrix = array_argument(name, value)
    if matrix.shape not in {(4, 4), (3, 4)} or matrix.dtype.kind not in "fiu":
        raise InputError(
            f"{name}: expected a pose as a matrix (4, 4) from camera to world, "
            f"found {matrix.shape} of {matrix.dtype}"
        )
    rotation, position_m = matrix[:3, :3].astype(np.float64), matrix[:3, 3].astype(np.float64)
    if not np.isfinite(matrix).all():
        raise InputError(f"{name}: expected finite numbers, found some that are not")
    error = float(np.abs(rotation @ rotation.T - np.eye(3)).max())
    if error > ROTATION_ERROR or np.linalg.det(rotation) < 0:
        raise InputError(
            f"{name}: expected a rotation, found a matrix that is {error:.2g} off one"
            if error > ROTATION_ERROR
            else f"{name}: expected a rotation, found a reflection"
        )
    left, _, right = np.linalg.svd(rotation)
    return CameraPose(left @ right, position_m)
