"""2-D roughness, which no method's table has, as a measure of a mask."""

import numpy as np
from numpy.typing import NDArray

import rockshape
from validation.peers.declare import expected_trait


@expected_trait(roughness_2d="roughness")
def measure(mask: NDArray[np.bool_]) -> dict[str, float]:
    """Roughness of a mask; NaN where it is refused."""
    return {"roughness_2d": rockshape.roughness_2d(mask)}
