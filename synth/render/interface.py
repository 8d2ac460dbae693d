"""Interface of rendering backends."""

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from synth.camera.pose import Pose


class Renderer(Protocol):
    """Renderer of a stage with a camera, from any pose."""

    def measure(
        self, pose: Pose, limits_m: tuple[float, float], rocks: Sequence[int] | None
    ) -> tuple[NDArray[np.uint16], NDArray[np.float64]]:
        """Labels and z-depth, each (rows, cols), sampled at the pixels' centres.

        Labels are 1 + the index among rocks and, after them, things, 0 elsewhere; depth is in
        metres, NaN where nothing is.
        With `rocks` given, only those rocks exist, and no ground. `limits_m` holds all depths.
        """
