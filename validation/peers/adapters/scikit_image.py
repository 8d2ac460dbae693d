"""scikit-image's region properties."""

import numpy as np
from numpy.typing import NDArray
from skimage.measure import regionprops

from validation.peers.declare import expected_trait


@expected_trait(
    solidity="roundness", circularity="roundness", axis_ratio="form", diameter_ratio="form"
)
def measure(mask: NDArray[np.bool_]) -> dict[str, float]:
    """Solidity, circularity 4πA/P², moment axis ratio and diameter ratio of a mask.

    The last is the diameter of the disc of equal area over the longest Feret diameter.
    """
    (region,) = regionprops(mask.astype(np.uint8))
    perimeter, longest = region.perimeter_crofton, region.feret_diameter_max
    major = region.axis_major_length
    return {
        "solidity": region.solidity,
        "circularity": 4 * np.pi * region.area / perimeter**2 if perimeter else np.nan,
        "axis_ratio": region.axis_minor_length / major if major else np.nan,
        "diameter_ratio": np.sqrt(4 * region.area / np.pi) / longest if longest else np.nan,
    }
