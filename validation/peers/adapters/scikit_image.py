"""scikit-image's region properties."""

import numpy as np
from numpy.typing import NDArray
from skimage.measure import regionprops

from validation.peers.adapters.each import of_each_rock
from validation.peers.declare import rises_with


@rises_with(solidity="roundness", circularity="roundness", axis_ratio="form", diameter_ratio="form")
def measure(
    image: NDArray[np.float32],
    labels: NDArray[np.int32],
    points_m: NDArray[np.float64] | None,
) -> dict[str, list[float]]:
    """Solidity, circularity 4πA/P², the moments' axis ratio, and a ratio of diameters.

    The last is the diameter of the disc of equal area over the longest Feret diameter.
    """

    def of_mask(mask: NDArray[np.bool_]) -> dict[str, float]:
        (region,) = regionprops(mask.astype(np.uint8))
        perimeter, longest = region.perimeter_crofton, region.feret_diameter_max
        major = region.axis_major_length
        return {
            "solidity": region.solidity,
            "circularity": 4 * np.pi * region.area / perimeter**2 if perimeter else np.nan,
            "axis_ratio": region.axis_minor_length / major if major else np.nan,
            "diameter_ratio": np.sqrt(4 * region.area / np.pi) / longest if longest else np.nan,
        }

    return of_each_rock(labels, of_mask)
