"""The pinhole camera: pixels to rays and back.

Frame: x right, y down, z forward; whole pixel coordinates are pixel centres, (0, 0) the centre of
the upper-left pixel.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError


@dataclass(frozen=True)
class Camera:
    """Intrinsics of a camera without distortion.

    Raises InputError where a focal length or a side is not positive.
    """

    fx: float  # px
    fy: float  # px
    cx: float  # px, of the principal point
    cy: float  # px
    width: int  # px
    height: int  # px
    depth_scale: float | None = None  # mm for one unit of a 16-bit depth image, as in BOP

    def __post_init__(self) -> None:
        for name in ("fx", "fy", "width", "height", "depth_scale"):
            value = getattr(self, name)
            if value is not None and not (np.isfinite(value) and value > 0):
                raise InputError(f"camera: {name}: expected a positive number, found {value}")

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the images this camera takes."""
        return self.height, self.width

    def unproject(self, depth_m: NDArray[np.floating]) -> NDArray[np.float64]:
        """Points seen at each pixel: X = Z (u - cx)/fx, Y = Z (v - cy)/fy.

        depth_m is (rows, cols) z-depth, NaN where nothing was measured; the result is
        (rows, cols, 3) in the camera frame, metres.
        Raises InputError where the depth is not of the camera's shape.
        """
        if depth_m.shape != self.shape:
            raise InputError(
                f"depth_m: expected {self.shape} as the camera says, found {depth_m.shape}"
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
