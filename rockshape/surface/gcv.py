"""Generalised cross-validation of a surface's smoothing."""

import numpy as np
from numpy.typing import NDArray

from rockshape.surface.normal_equations import factorise

MIN_LENGTH, MAX_LENGTH = 1e-3, 1.0  # of the length at which penalty and data weigh alike
STEPS = 13  # of the first search, evenly in the logarithm
ROUNDS = 12  # of the golden section that follows
GOLDEN = (5**0.5 - 1) / 2


def best_smoothing(
    bands: NDArray[np.float64],
    side: NDArray[np.float64],
    penalty: NDArray[np.float64],
    *,
    energy: float,
    count: float,
) -> float:
    """The length l of the least n RSS/(n - tr H)², for the penalty n l⁴ P.

    bands (band + 1, size) and side (size,) are the normal equations, penalty (band + 1, size) the
    bands of P, energy the data's sum of squares and count their number n. With B the vertices,
    RSS = energy - 2 B . side + B . A B, and tr H = tr((A + n l⁴ P)^-1 A): both from the banded
    factor alone.
    """
    alike = (bands[0].sum() / (count * penalty[0].sum())) ** 0.25

    def score(share: float) -> float:
        weight = count * (alike * share) ** 4
        factor = factorise(bands + weight * penalty)
        if factor is None:
            return float("inf")
        vertices = factor.solve(side)
        misfit = energy - 2 * vertices @ side + vertices @ _times(bands, vertices)
        square = max(float(misfit), 0.0)
        dense = _dense(penalty)
        # tr H = size - n l⁴ tr((A + n l⁴ P)^-1 P)
        freedom = len(side) - weight * float(np.trace(factor.solve(dense)))
        return float(count * square / max(count - freedom, 1e-9 * count) ** 2)

    places = np.geomspace(MIN_LENGTH, MAX_LENGTH, STEPS)
    scores = [score(place) for place in places]
    best = int(np.argmin(scores))
    low, high = np.log(places[max(best - 1, 0)]), np.log(places[min(best + 1, STEPS - 1)])
    inner = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    values = [score(float(np.exp(place))) for place in inner]
    for _ in range(ROUNDS):
        if values[0] <= values[1]:
            high, inner = inner[1], (inner[1] - GOLDEN * (inner[1] - low), inner[0])
            values = [score(float(np.exp(inner[0]))), values[0]]
        else:
            low, inner = inner[0], (inner[1], inner[0] + GOLDEN * (high - inner[0]))
            values = [values[1], score(float(np.exp(inner[1])))]
    return float(alike * np.exp((low + high) / 2))


def _times(bands: NDArray[np.float64], vector: NDArray[np.float64]) -> NDArray[np.float64]:
    """The product of a symmetric banded matrix and a vector (size,)."""
    result = bands[0] * vector
    for below in range(1, len(bands)):
        line = bands[below, :-below]
        result[below:] += line * vector[:-below]
        result[:-below] += line * vector[below:]
    return np.asarray(result)


def _dense(bands: NDArray[np.float64]) -> NDArray[np.float64]:
    """The symmetric matrix (size, size) of lower bands."""
    size = bands.shape[1]
    dense = np.diag(bands[0])
    place = np.arange(size)
    for below in range(1, len(bands)):
        dense[place[below:], place[:-below]] = bands[below, :-below]
        dense[place[:-below], place[below:]] = bands[below, :-below]
    return dense
