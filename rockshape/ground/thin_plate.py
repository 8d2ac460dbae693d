"""The smooth surface through values on a grid, some of them missing."""

import numpy as np
from scipy.linalg import solveh_banded

from rockshape.numerics.arrays import Singles

SECOND = (1.0, -2.0, 1.0)
FIRST = (-1.0, 1.0)
TWIST = ((1.0, -1.0), (-1.0, 1.0))
MIN_WEIGHT = 1e-5  # of a missing value, at height 0: single precision must tell it from nothing


def bend(value: Singles, weight: Singles, *, stiff: float, taut: float) -> Singles:
    """The surface s (rows, cols) that minimises sum w (v - s)^2 + stiff B(s) + taut T(s).

    B is the sum of squared second differences along both axes and, twice, across; T that of squared
    first differences. value and weight are (rows, cols); where the weight is 0 the surface is what
    bends and rises least. The normal equations are banded, as wide as two rows, and solved by
    Cholesky's way.
    """
    turned = value.shape[1] > value.shape[0]  # short rows make a narrow band
    if turned:
        value, weight = value.T, weight.T
    bands = _bands(value.shape, stiff=stiff, taut=taut)
    bands[0] += weight + np.float32(MIN_WEIGHT)
    surface = solveh_banded(
        bands.reshape(len(bands), -1), (weight * value).ravel(), lower=True, check_finite=False
    ).reshape(value.shape)
    return np.asarray(surface.T if turned else surface)


def _bands(shape: tuple[int, ...], *, stiff: float, taut: float) -> Singles:
    """The diagonals of stiff B + taut T from the main one down, (2 cols + 1, rows, cols)."""
    rows, cols = shape
    bands = np.zeros((2 * cols + 1, rows, cols), dtype=np.float32)
    for share, stencil in (
        (stiff, np.array([SECOND])),
        (stiff, np.array([SECOND]).T),
        (2 * stiff, np.array(TWIST)),
        (taut, np.array([FIRST])),
        (taut, np.array([FIRST]).T),
    ):
        high, wide = rows - stencil.shape[0] + 1, cols - stencil.shape[1] + 1
        if high < 1 or wide < 1:
            continue
        for one, mine in np.ndenumerate(stencil):
            for two, theirs in np.ndenumerate(stencil):
                below = (two[0] - one[0]) * cols + two[1] - one[1]
                if below >= 0:
                    place = np.s_[one[0] : one[0] + high, one[1] : one[1] + wide]
                    bands[below][place] += share * mine * theirs
    return bands
