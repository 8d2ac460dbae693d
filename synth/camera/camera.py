"""Camera record: focal lengths, principal point, frame and lens, in OpenCV's frame.

x points right, y down, z forward.
"""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats


@dataclass(frozen=True)
class RenderCamera:
    """Pinhole camera, with a lens or without; integer pixel coordinates are pixel centres."""

    fx: float  # pixels
    fy: float  # pixels
    cx: float  # pixels
    cy: float  # pixels
    width: int  # pixels
    height: int  # pixels
    distortion: tuple[float, ...] | None = None  # k1, k2, p1, p2, k3 of OpenCV; None: a pinhole

    def matrix(self) -> Floats:
        """Camera matrix K, (3, 3): pixels from camera coordinates over depth."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])

    def refined(self, factor: int) -> "RenderCamera":
        """Camera with each pixel split into factor × factor, over the same field."""
        return RenderCamera(
            fx=self.fx * factor,
            fy=self.fy * factor,
            cx=(self.cx + 0.5) * factor - 0.5,
            cy=(self.cy + 0.5) * factor - 0.5,
            width=self.width * factor,
            height=self.height * factor,
            distortion=self.distortion,
        )
