"""partimorph: Wadell's roundness, circularity, sphericity and axis ratio of a mask."""

import numpy as np
from numpy.typing import NDArray
from partimorph import analyze_mask

from validation.peers.adapters.each import of_each_rock
from validation.peers.declare import rises_with


@rises_with(roundness="roundness", circularity="roundness", sphericity="form", axis_ratio="form")
def measure(
    image: NDArray[np.float32],
    labels: NDArray[np.int32],
    points_m: NDArray[np.float64] | None,
) -> dict[str, list[float]]:
    """Its four numbers, the axis ratio short over long; NaN where it has none."""

    def of_mask(mask: NDArray[np.bool_]) -> dict[str, float]:
        found = analyze_mask(mask.astype(np.uint8)) or {}

        def value(name: str) -> float:
            return float((found.get(name) or {}).get("val", np.nan))

        return {
            "roundness": value("roundness"),
            "circularity": value("circularity"),
            "sphericity": value("sphericity"),
            "axis_ratio": 1.0 / value("aspect_ratio"),
        }

    return of_each_rock(labels, of_mask)
