"""What the network answers at each pixel."""

from dataclasses import dataclass

import numpy as np

from rockshape.numerics.arrays import Singles

CHANNELS = 4  # logits of rock and border, logit of distance, code of width
STRIDE = 32  # sides of its pictures are multiples of this
NARROWEST_PX, WIDEST_PX = 4.0, 160.0
_MIDDLE_PX = 24.0


@dataclass(frozen=True, eq=False)
class Answer:
    """Maps (rows, cols)."""

    rock: Singles  # probability that the pixel shows a rock
    border: Singles  # probability that another rock or the ground is within a pixel
    distance: Singles  # to the rock's border, over the greatest within the rock
    width_px: Singles  # least width of the rock seen there


def width_code(width_px: Singles) -> Singles:
    """Number near 0 that stands for a width."""
    return np.asarray(np.log2(width_px / _MIDDLE_PX), dtype=np.float32)


def width_of(code: Singles) -> Singles:
    """Width that a number stands for, px."""
    return np.asarray(_MIDDLE_PX * np.exp2(code), dtype=np.float32)
