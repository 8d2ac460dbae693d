"""Random streams of the sensor: one for each use, so that none reshuffles another."""

import hashlib
from enum import IntEnum

import numpy as np


class Use(IntEnum):
    """Use of a stream; the values are part of what a seed means."""

    PICTURE = 601
    RIGHT_PICTURE = 602
    DISPARITY = 603
    COLOUR = 604
    DEVELOPMENT = 605


def stream(use: Use | str, *, seed: int, scene: int, view: int) -> np.random.Generator:
    """Random numbers of one use in one view; a registered sensor names uses of its own."""
    if isinstance(use, str):
        key = int.from_bytes(hashlib.sha256(use.encode()).digest()[:8], "big")
    else:
        key = int(use)
    return np.random.default_rng([seed, scene, key, view])
