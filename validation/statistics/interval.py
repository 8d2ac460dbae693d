"""Bootstrap intervals over rocks."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

LEVEL = 0.95
REPLICATES = 1000


def bootstrap_interval(
    statistic: Callable[[NDArray[np.float64]], float],
    count: int,
    *,
    rng: np.random.Generator,
    replicates: int = REPLICATES,
) -> tuple[float, float]:
    """95 % percentile interval of a statistic of weighted rocks (Efron 1979).

    `statistic` takes one weight a rock, (count,): how often a draw with replacement took it. A
    pair of a rock with its own copy says nothing and does not exist. A statistic that is perfect
    on the sample stays perfect in every draw: such an interval has no width, whatever the number
    of rocks. NaN, NaN with fewer than two rocks or when the statistic is mostly undefined.
    """
    if count < 2:
        return float("nan"), float("nan")
    draws = rng.multinomial(count, np.full(count, 1.0 / count), size=replicates)
    found = np.array([statistic(weights.astype(np.float64)) for weights in draws])
    found = found[np.isfinite(found)]
    if found.size < replicates / 2:
        return float("nan"), float("nan")
    tail = (1.0 - LEVEL) / 2.0
    low, high = np.quantile(found, [tail, 1.0 - tail])
    return float(low), float(high)
