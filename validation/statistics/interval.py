"""Bootstrap over rocks: draws, the statistic in each, and its interval."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from validation.arrays import Floats

LEVEL = 0.95
REPLICATES = 1000
_BATCH = 50  # draws: the weights of all pairs of rocks of a batch are in memory at once

Weighted = Callable[[Floats], Floats]  # a statistic of (draws, rocks) weights, (draws,)


def draws_of(count: int, *, rng: np.random.Generator, replicates: int) -> NDArray[np.int64]:
    """Draws of so many rocks with replacement: how often each was taken, (replicates, count)."""
    return rng.multinomial(count, np.full(count, 1.0 / count), size=replicates)


def in_draws(statistic: Weighted, draws: NDArray[np.int64]) -> Floats:
    """Statistic in each draw, (draws,)."""
    batches = np.array_split(draws, max(1, len(draws) // _BATCH))
    return np.concatenate([statistic(batch.astype(np.float64)) for batch in batches])


def of_sample(statistic: Weighted, count: int) -> float:
    """Statistic of the sample itself, in which each rock weighs one."""
    return float(statistic(np.ones((1, count)))[0])


def bootstrap_interval(
    statistic: Weighted,
    count: int,
    *,
    rng: np.random.Generator,
    replicates: int = REPLICATES,
) -> tuple[float, float]:
    """95 % percentile interval of a statistic of weighted rocks (Efron 1979).

    `statistic` takes one weight a rock, (draws, count): how often a draw with replacement took
    it. A pair of a rock with its own copy says nothing and does not exist. A statistic that is
    perfect on the sample stays perfect in every draw: such an interval has no width, whatever the
    number of rocks. NaN, NaN with fewer than two rocks or when the statistic is mostly undefined.
    """
    if count < 2:
        return float("nan"), float("nan")
    found = in_draws(statistic, draws_of(count, rng=rng, replicates=replicates))
    found = found[np.isfinite(found)]
    if found.size < replicates / 2:
        return float("nan"), float("nan")
    tail = (1.0 - LEVEL) / 2.0
    low, high = np.quantile(found, [tail, 1.0 - tail])
    return float(low), float(high)
