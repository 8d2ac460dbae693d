"""Graphic statistics of grain size after Folk and Ward: mean, sorting, skewness, kurtosis.

φ = −log2 D, D in millimetres; φp is the size than which p percent are coarser.

Source: Folk and Ward (1957), Journal of Sedimentary Petrology 27, pp. 12 to 14.
"""

from dataclasses import dataclass

import numpy as np

from rockshape.numerics.arrays import Floats

PERCENTS = (5.0, 16.0, 25.0, 50.0, 75.0, 84.0, 95.0)  # finer, of the sizes that `folk_ward` takes
_SORTING = (
    (0.35, "very well sorted"),
    (0.5, "well sorted"),
    (0.71, "moderately well sorted"),
    (1.0, "moderately sorted"),
    (2.0, "poorly sorted"),
    (4.0, "very poorly sorted"),
    (np.inf, "extremely poorly sorted"),
)
_SKEWNESS = (
    (-0.3, "strongly coarse skewed"),
    (-0.1, "coarse skewed"),
    (0.1, "near symmetrical"),
    (0.3, "fine skewed"),
    (np.inf, "strongly fine skewed"),
)


@dataclass(frozen=True)
class FolkWard:
    """Graphic mean, inclusive standard deviation, inclusive skewness and kurtosis, in φ."""

    mean_phi: float
    sorting_phi: float
    skewness: float
    kurtosis: float

    @property
    def sorting_class(self) -> str:
        """Words for the sorting."""
        return _word(self.sorting_phi, _SORTING)

    @property
    def skewness_class(self) -> str:
        """Words for the skewness."""
        return _word(self.skewness, _SKEWNESS)


def folk_ward(sizes_mm: Floats) -> FolkWard:
    """Statistics of the sizes (7,) below which `PERCENTS` lie.

    With them in φ, coarser than which 5, 16, 25, 50, 75, 84 and 95 % lie:
    mean (φ16 + φ50 + φ84)/3, sorting (φ84 − φ16)/4 + (φ95 − φ5)/6.6,
    skewness (φ16 + φ84 − 2φ50)/(2(φ84 − φ16)) + (φ5 + φ95 − 2φ50)/(2(φ95 − φ5)),
    kurtosis (φ95 − φ5)/(2.44(φ75 − φ25)). NaN where a spread is 0.
    """
    p5, p16, p25, p50, p75, p84, p95 = (float(each) for each in -np.log2(sizes_mm[::-1]))
    with np.errstate(divide="ignore", invalid="ignore"):
        inner, outer, middle = np.float64(p84 - p16), np.float64(p95 - p5), np.float64(p75 - p25)
        return FolkWard(
            mean_phi=(p16 + p50 + p84) / 3,
            sorting_phi=float(inner / 4 + outer / 6.6),
            skewness=float(
                (p16 + p84 - 2 * p50) / (2 * inner) + (p5 + p95 - 2 * p50) / (2 * outer)
            ),
            kurtosis=float(outer / (2.44 * middle)),
        )


def _word(value: float, classes: tuple[tuple[float, str], ...]) -> str:
    return next((word for end, word in classes if value < end), "")
