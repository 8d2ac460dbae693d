"""Classes of form and roundness: Zingg, Sneed and Folk, Powers, Krumbein.

Sources: Zingg (1935); Sneed and Folk (1958), Journal of Geology 66, figure 2; Powers (1953),
Journal of Sedimentary Petrology 23, table 1; Krumbein (1941), the same journal 11, plate 1.
"""

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Floats

ZINGG = ("disc", "spheroid", "blade", "rod")
POWERS = ("very angular", "angular", "subangular", "subrounded", "rounded", "well rounded")
SNEED_FOLK = (
    "compact",
    "compact platy",
    "compact bladed",
    "compact elongate",
    "platy",
    "bladed",
    "elongate",
    "very platy",
    "very bladed",
    "very elongate",
)
KRUMBEIN = tuple(f"{tenth / 10:.1f}" for tenth in range(1, 10))

ZINGG_BOUND = 2 / 3
_POWERS_BOUNDS = (0.17, 0.25, 0.35, 0.49, 0.70)
_FLATTEST = (0.3, 0.5, 0.7)  # S/L that part very …, plain, compact … and compact
_THIRDS = (1 / 3, 2 / 3)  # of (L − I)/(L − S), from platy to elongate

Classes = NDArray[np.int64]


def zingg(a: Floats, b: Floats, c: Floats) -> Classes:
    """Class (n,) in `ZINGG` of axes a ≥ b ≥ c: by b/a and c/b, parted at 2/3."""
    long_enough, thick = b / a >= ZINGG_BOUND, c / b >= ZINGG_BOUND
    return np.where(long_enough, np.where(thick, 1, 0), np.where(thick, 3, 2))


def sneed_folk(a: Floats, b: Floats, c: Floats) -> Classes:
    """Class (n,) in `SNEED_FOLK` of axes a ≥ b ≥ c: by c/a and (a − b)/(a − c)."""
    with np.errstate(invalid="ignore"):
        third = np.searchsorted(_THIRDS, np.nan_to_num((a - b) / (a - c)), side="right")
    band = np.searchsorted(_FLATTEST, c / a, side="right")
    first = np.array([7, 4, 1])[np.minimum(band, 2)]
    return np.where(band == 3, 0, first + third)


def powers(roundness: Floats) -> Classes:
    """Class (n,) in `POWERS` of Wadell's roundness."""
    return np.searchsorted(_POWERS_BOUNDS, roundness, side="right")


def krumbein(roundness: Floats) -> Classes:
    """Class (n,) in `KRUMBEIN` of Wadell's roundness: the nearest tenth of the chart."""
    return np.clip(np.floor(10 * roundness + 0.5).astype(np.int64), 1, 9) - 1


def shares(classes: Classes, count: int) -> Floats:
    """Share (count,) of each class."""
    return np.bincount(classes, minlength=count) / max(len(classes), 1)
