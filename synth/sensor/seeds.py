"""Random numbers of the sensor: one stream for each use, so that none reshuffles another."""

from enum import IntEnum

import numpy as np


class Use(IntEnum):
    """What a stream is for; the values are part of what a seed means."""

    PICTURE = 601
    RIGHT_PICTURE = 602
    DISPARITY = 603


def stream(use: Use, *, seed: int, scene: int, view: int) -> np.random.Generator:
    """Return the random numbers of one use in one view."""
    return np.random.default_rng([seed, scene, int(use), view])
