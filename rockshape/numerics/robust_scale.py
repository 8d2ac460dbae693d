"""Robust scale of residuals: the median absolute deviation in units of a standard deviation."""

import numpy as np

from rockshape.numerics.arrays import Floats

MEDIAN_TO_SIGMA = 1.4826022  # 1/Φ⁻¹(3/4): of a normal distribution the median of |x| is 0.6745 σ


def median_scale(residuals: Floats) -> float:
    """Robust standard deviation of residuals (n,) about 0, 1.4826 median |r|; NaN for none.

    Consistent for normal residuals. Half of them can be anything without carrying it away
    (breakdown point 1/2).
    Source: Hampel (1974), The influence curve and its role in robust estimation.
    """
    if len(residuals) == 0:
        return float("nan")
    return MEDIAN_TO_SIGMA * float(np.median(np.abs(residuals)))
