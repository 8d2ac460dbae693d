"""Stereo rig: disparity and depth of two parallel cameras."""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats
from synth.camera.presets import PRESETS
from synth.errors import SpecError


@dataclass(frozen=True)
class Rig:
    """Stereo rig: equal cameras with parallel axes; the right one a baseline along x."""

    focal_px: float
    baseline_m: float

    def disparity_px(self, depth_m: Floats) -> Floats:
        """Disparity d = f B / Z, the column in the left image less that in the right; NaN stays."""
        return np.asarray(self.focal_px * self.baseline_m / depth_m)

    def depth_m(self, disparity_px: Floats) -> Floats:
        """Depth Z = f B / d, NaN where the disparity is not positive."""
        known = np.where(disparity_px > 0.0, disparity_px, np.nan)
        return np.asarray(self.focal_px * self.baseline_m / known)

    def depth_sd_m(self, depth_m: Floats, disparity_sd_px: float) -> Floats:
        """Depth error σ_Z = Z² σ_d / (f B), the first order of Z = f B / d."""
        return np.asarray(depth_m**2 * disparity_sd_px / (self.focal_px * self.baseline_m))


def rig_of(preset: str) -> Rig:
    """Stereo rig of a camera preset.

    Raises:
        SpecError: the preset has one eye.
    """
    found = PRESETS[preset]
    if found.baseline_m is None:
        raise SpecError(f"noise.kind: expected a preset with two eyes, found {preset!r}")
    return Rig(focal_px=found.camera.fx, baseline_m=found.baseline_m)
