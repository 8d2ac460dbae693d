"""Level ground seen by a camera of known height and tilt: how far the foot of a rock is."""

import math
from dataclasses import dataclass

from rockshape.camera.camera import Camera
from rockshape.errors import InputError


@dataclass(frozen=True)
class LevelGround:
    """Level, flat ground below a camera that is not rolled."""

    height_m: float  # of the camera above it
    tilt_deg: float  # of the line of sight below the horizon

    def __post_init__(self) -> None:
        """Ask for a camera above the ground that does not look at the sky alone."""
        if not 0 < self.height_m < math.inf:
            raise InputError(f"camera_height_m: expected a height above 0, found {self.height_m}")
        if not -45 <= self.tilt_deg <= 90:
            raise InputError(
                f"tilt_deg (--tilt): expected -45 to 90 below the horizon, found {self.tilt_deg:g}"
            )

    def depth_m(self, row: float, camera: Camera) -> float:
        """Depth along the line of sight of the ground at a row of the image; NaN at the sky.

        A ray (x, y, 1) goes down by y cos t + sin t for each metre of depth, t the tilt.
        """
        tilt = math.radians(self.tilt_deg)
        down = (row - camera.cy) / camera.fy * math.cos(tilt) + math.sin(tilt)
        return self.height_m / down if down > 0 else math.nan
