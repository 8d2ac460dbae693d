"""imea: two-dimensional shape measurements (Kroell 2021)."""

import warnings

import imea
import numpy as np
from numpy.typing import NDArray

from validation.peers.declare import expected_trait


@expected_trait(
    solidity="roundness", circularity="roundness", axis_ratio="form", feret_ratio="form"
)
def measure(mask: NDArray[np.bool_]) -> dict[str, float]:
    """Shape factors of a mask from its areas, perimeter, axes and Feret diameters."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", FutureWarning)  # names it takes from scikit-image
        found = imea.shape_measurements_2d(mask).iloc[0]
    return {
        "solidity": found["area_projection"] / found["area_convex"],
        "circularity": 4 * np.pi * found["area_projection"] / found["perimeter"] ** 2,
        "axis_ratio": found["minor_axis_length"] / found["major_axis_length"],
        "feret_ratio": found["feret_min"] / found["feret_max"],
    }
