"""fast_rs: roundness and sphericity from the local thickness (Pieta et al. 2025)."""

import numpy as np
from fast_rs import rs
from numpy.typing import NDArray

from validation.peers.adapters.each import of_each_rock
from validation.peers.declare import rises_with


@rises_with(roundness="roundness", sphericity="form")
def measure(
    image: NDArray[np.float32],
    labels: NDArray[np.int32],
    points_m: NDArray[np.float64] | None,
) -> dict[str, list[float]]:
    """Its approximate roundness and sphericity, with its own defaults."""

    def of_mask(mask: NDArray[np.bool_]) -> dict[str, float]:
        roundness, sphericity, _ = rs.rs_calculate(mask)
        return {"roundness": roundness[0], "sphericity": sphericity[0]}

    return of_each_rock(labels, of_mask)
