"""A pair of eyes side by side: disparity and depth."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.camera import Pose

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Rig:
    """Two equal cameras with parallel axes; the right one stands a baseline along x."""

    focal_px: float
    baseline_m: float

    def disparity_px(self, depth_m: Floats) -> Floats:
        """Return d = f B / Z, the column in the left image less that in the right; NaN stays."""
        return np.asarray(self.focal_px * self.baseline_m / depth_m)

    def depth_m(self, disparity_px: Floats) -> Floats:
        """Return Z = f B / d, NaN where the disparity is not positive."""
        known = np.where(disparity_px > 0.0, disparity_px, np.nan)
        return np.asarray(self.focal_px * self.baseline_m / known)

    def depth_sd_m(self, depth_m: Floats, disparity_sd_px: float) -> Floats:
        """Return σ_Z = Z² σ_d / (f B), the first order of Z = f B / d."""
        return np.asarray(depth_m**2 * disparity_sd_px / (self.focal_px * self.baseline_m))


# Imager for Mars Pathfinder (Smith et al. 1997), engineering cameras of Mars Science Laboratory
# (Maki et al. 2012).
_BASELINES_M = {"imp": 0.150, "msl-navcam": 0.424}


def baseline_m(preset: str) -> float:
    """Return the distance between a preset's two eyes."""
    return _BASELINES_M[preset]


def right_eye(pose: Pose, baseline_m: float) -> Pose:
    """Return the pose of the right eye, a baseline along the left one's x."""
    shift_m = np.array([baseline_m, 0.0, 0.0])
    return Pose(world_to_camera=pose.world_to_camera, translation_m=pose.translation_m - shift_m)
