"""partimorph: Wadell's roundness, circularity, sphericity and axis ratio of a mask."""

import numpy as np
from numpy.typing import NDArray
from partimorph import analyze_mask

from validation.peers.declare import expected_trait


@expected_trait(
    roundness="roundness", circularity="roundness", sphericity="form", axis_ratio="form"
)
def measure(mask: NDArray[np.bool_]) -> dict[str, float]:
    """Four shape numbers of a mask, the axis ratio short over long; NaN where there is none."""
    found = analyze_mask(mask.astype(np.uint8)) or {}

    def value(name: str) -> float:
        return float((found.get(name) or {}).get("val", np.nan))

    return {
        "roundness": value("roundness"),
        "circularity": value("circularity"),
        "sphericity": value("sphericity"),
        "axis_ratio": 1.0 / value("aspect_ratio"),
    }
