"""Robust scales of residuals, in units of a normal distribution's standard deviation."""

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


BIWEIGHT_CUT = 2.5  # standard deviations from which a residual counts as one at infinity
BIWEIGHT_MEAN = 0.309164  # E ρ(z/2.5) of the standard normal distribution: the consistency constant
_ROUNDS = 50
_SETTLED = 1e-9


def biweight_scale(residuals: Floats) -> float:
    """M-scale s of residuals (n,) about 0 with Tukey's biweight; NaN for none.

    s solves mean ρ(r/(2.5 s)) = 0.309164 with ρ(u) = 1 - (1 - u²)³ for |u| < 1 and 1 beyond, the
    constant being the mean for normal residuals of standard deviation 1. Two in a hundred spoiled
    residuals move it by 3.8 % at most, wherever they lie; it breaks down at 31 %. 0 where most
    residuals are 0.
    Source: Huber and Ronchetti (2009), Robust Statistics, section 5.3.
    """
    scale = median_scale(residuals)
    if not scale > 0:
        return scale
    for _ in range(_ROUNDS):
        level = np.minimum((residuals / (BIWEIGHT_CUT * scale)) ** 2, 1.0)
        ratio = float(np.mean(1 - (1 - level) ** 3)) / BIWEIGHT_MEAN
        scale *= np.sqrt(ratio)
        if abs(ratio - 1) < _SETTLED:
            break
    return float(scale)
