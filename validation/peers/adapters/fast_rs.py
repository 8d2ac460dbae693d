"""fast_rs: roundness and sphericity from the local thickness (Pieta et al. 2025)."""

import numpy as np
from fast_rs import rs
from numpy.typing import NDArray

from validation.peers.declare import expected_trait


@expected_trait(roundness="roundness", sphericity="form")
def measure(mask: NDArray[np.bool_]) -> dict[str, float]:
    """Approximate roundness and sphericity of a mask, with the package's defaults."""
    roundness, sphericity, _ = rs.rs_calculate(mask.copy())  # it wants an array that may be written
    return {"roundness": roundness[0], "sphericity": sphericity[0]}
