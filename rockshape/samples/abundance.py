"""Rock abundance of a field, and the Golombek–Rapp distribution fitted to its rocks.

F(D) = k exp(−q(k) D), q(k) = 1.79 + 0.152/k: share of the ground under rocks wider than D metres.

Source: Golombek and Rapp (1997), Journal of Geophysical Research 102, equations 6 and 7.
"""

from dataclasses import dataclass

import numpy as np
from scipy import optimize, special

from rockshape.numerics.arrays import Floats

LEAST_K, _MOST_K = 1e-3, 0.9  # between which k is sought
_LEVEL = 1.920729410347062  # half of the 95 % quantile of χ² with one degree of freedom
_BRACKET = 200


@dataclass(frozen=True)
class Abundance:
    """Abundance k of rocks with the interval of 95 % that the likelihood tells."""

    k: float
    low: float
    high: float
    covered: float  # share of the area under the rocks that were counted, as discs
    rocks: int


def decay_per_m(k: float) -> float:
    """Exponent q of the distribution, 1/m."""
    return 1.79 + 0.152 / k


def rocks_per_m2(k: float, least_m: float) -> float:
    """Number of rocks wider than `least_m` on a square metre.

    n(D) = q F/(π D²/4) integrated: (4 k q/π) ∫ exp(−q D)/D² dD = (4 k q/π) E2(q d)/d.
    """
    q = decay_per_m(k)
    return float(4.0 * k * q / np.pi * special.expn(2, q * least_m) / least_m)


def fit_abundance(diameters_m: Floats, *, area_m2: float, least_m: float) -> Abundance:
    """Fit of k to all rocks (n,) wider than `least_m` that lie on an area.

    The rocks are a Poisson process of density n(D): log L(k) = Σ log n(D_i) − A N(k).
    """
    counted = diameters_m[diameters_m >= least_m]

    def log_likelihood(k: float) -> float:
        q = decay_per_m(k)
        expected = area_m2 * rocks_per_m2(k, least_m)
        return float(len(counted) * np.log(k * q) - q * counted.sum() - expected)

    grid = np.geomspace(LEAST_K, _MOST_K, _BRACKET)
    best = int(np.argmax([log_likelihood(k) for k in grid]))
    around = grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)]
    k = float(
        optimize.minimize_scalar(
            lambda log_k: -log_likelihood(np.exp(log_k)), bounds=np.log(around), method="bounded"
        ).x
    )
    k = float(np.exp(k))
    least = log_likelihood(k) - _LEVEL

    def end(bound: float) -> float:
        if log_likelihood(bound) >= least:
            return bound
        return float(optimize.brentq(lambda each: log_likelihood(each) - least, bound, k))

    return Abundance(
        k=k,
        low=end(LEAST_K),
        high=end(_MOST_K),
        covered=float(np.pi / 4 * (counted**2).sum() / area_m2),
        rocks=len(counted),
    )
