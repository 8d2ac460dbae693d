"""What the camera gave: a grey image and, where it was measured, the point seen at each pixel."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera
from rockshape.errors import InputError

if TYPE_CHECKING:
    from rockshape.camera.resection import Resection

SURE_RESIDUAL_PX = 0.5  # a camera at the origin that explains the grid this well is the one
WORST_RESIDUAL_PX = 3.0  # a grid that no camera explains better than this is not one camera's


@dataclass(frozen=True, eq=False)
class Observation:
    """One image, and its range in the camera frame.

    points_m is (rows, cols, 3), NaN where nothing was measured, or None without range. With a
    camera the points are taken to be in its frame. Without one, points that a camera at their
    origin explains are left as they are; else the camera is resected from the grid, and `points_m`
    is moved to the camera found. `resection` tells it and its residual.
    Raises InputError where the shapes do not fit each other.
    """

    image: NDArray[np.float32]  # (rows, cols), 0..1
    points_m: NDArray[np.float64] | None = None  # (rows, cols, 3)
    camera: Camera | None = None
    resection: "Resection | None" = None

    def __post_init__(self) -> None:
        if self.image.ndim != 2 or self.image.size == 0:
            raise InputError(f"image: expected (rows, cols), found {self.image.shape}")
        if self.camera is not None and self.camera.shape != self.image.shape:
            raise InputError(
                f"camera: expected {self.image.shape} as the image has, found {self.camera.shape}"
            )
        if self.points_m is None:
            return
        expected = (*self.image.shape, 3)
        if self.points_m.shape != expected:
            raise InputError(f"points_m: expected {expected}, found {self.points_m.shape}")
        if self.camera is None:
            # brings scipy.optimize, a fifth of a second
            from rockshape.camera.resection import calibrate, resect  # noqa: PLC0415

            resection = calibrate(self.points_m)
            if resection is None or resection.residual_px > SURE_RESIDUAL_PX:
                resection = resect(self.points_m)
            if resection is not None and resection.residual_px <= WORST_RESIDUAL_PX:
                object.__setattr__(self, "resection", resection)
                object.__setattr__(self, "camera", resection.camera)
                object.__setattr__(self, "points_m", resection.to_camera(self.points_m))
