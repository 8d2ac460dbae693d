"""Rock populations by Golombek and Rapp: the number of rocks of each diameter."""

import numpy as np
from scipy.special import exp1

from synth.arrays import Floats
from synth.errors import SpecError
from synth.spec.population import PopulationSpec

MAX_ROCKS = 999  # in one scene, as object ids allow
_TABLE = 4000  # diameters at which the counts are tabulated


def decay_per_m(k: float) -> float:
    """Decay constant q = 1.79 + 0.152/k (Golombek and Rapp 1997)."""
    return 1.79 + 0.152 / k


def covered_share(diameter_m: float, k: float) -> float:
    """Cumulative area F(D) = k exp(−q D): the share of ground covered by rocks of at least D."""
    return float(k * np.exp(-decay_per_m(k) * diameter_m))


def number_per_m2(diameter_m: Floats | float, k: float) -> Floats:
    """Number of rocks of at least D on a square metre.

    The density n(D) = q F(D)/(πD²/4) integrated from D on, N(D) = (4qk/π)(e^(−qD)/D − q E₁(qD)).
    """
    q = decay_per_m(k)
    diameter = np.asarray(diameter_m, dtype=np.float64)
    return np.asarray(
        4.0 * q * k / np.pi * (np.exp(-q * diameter) / diameter - q * exp1(q * diameter))
    )


def expected_count(spec: PopulationSpec) -> float:
    """Mean number of rocks between d_min_m and d_max_m on the disc."""
    ends = number_per_m2(np.array([spec.d_min_m, spec.d_max_m]), spec.k)
    return float((ends[0] - ends[1]) * np.pi * spec.radius_m**2)


def draw_diameters_m(spec: PopulationSpec, *, rng: np.random.Generator) -> Floats:
    """Diameters of a Poisson number of rocks, (n,), longest first.

    Raises:
        SpecError: more rocks are expected than a scene can hold, or none came.
    """
    mean = expected_count(spec)
    count = int(rng.poisson(mean)) if mean <= MAX_ROCKS else MAX_ROCKS + 1
    if not 0 < count <= MAX_ROCKS:
        raise SpecError(
            f"population.d_min_m: expected 1 to {MAX_ROCKS} rocks on a disc of "
            f"{spec.radius_m:g} m, found {mean:.3g} on average"
        )
    table_m = np.geomspace(spec.d_max_m, spec.d_min_m, _TABLE)  # rising number
    numbers = number_per_m2(table_m, spec.k)
    drawn = rng.uniform(numbers[0], numbers[-1], size=count)
    return np.sort(np.interp(drawn, numbers, table_m))[::-1]
