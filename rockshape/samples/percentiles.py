"""Percentiles of grain sizes by number, area or weight, with bootstrap intervals."""

from collections.abc import Sequence

import numpy as np

from rockshape.numerics.arrays import Floats

PERCENTS = (5.0, 16.0, 25.0, 50.0, 75.0, 84.0, 90.0, 95.0)
DRAWS = 1000
_SEED = 1971


def percentiles(sizes: Floats, weights: Floats, percents: Sequence[float]) -> Floats:
    """Sizes (k,) below which percents of the weight (n,) of some sizes (n,) lie.

    The cumulative weight is taken to the middle of each grain, and the logarithm of size is linear
    between grains; below the first and above the last it stays.
    """
    order = np.argsort(sizes)
    return _of_sorted(sizes[order], weights[order], percents)


def _of_sorted(sizes: Floats, weights: Floats, percents: Sequence[float]) -> Floats:
    total = np.cumsum(weights)
    middle = (total - weights / 2) / total[-1]
    return np.asarray(np.exp(np.interp(np.asarray(percents) / 100, middle, np.log(sizes))))


def bootstrap_percentiles(
    sizes: Floats,
    power: float,
    percents: Sequence[float],
    *,
    sd: Floats | None,
    common_sd: float = 0.0,
    draws: int = DRAWS,
) -> Floats:
    """Percentiles (draws, k) of grains drawn with replacement, weighted by a power of their size.

    With `sd` (n,) each drawn size is moved by its own standard uncertainty too, so that intervals
    take both the count and the sizes' uncertainty along; with `common_sd` the logarithms of all
    sizes of a draw are moved alike. Draws depend on the number of grains only.
    """
    rng = np.random.default_rng([_SEED, len(sizes)])
    order = np.argsort(sizes)
    sizes, sd = sizes[order], None if sd is None else sd[order]
    weights = (sizes / sizes[-1]) ** power
    found = np.empty((draws, len(percents)))
    for draw in range(draws):
        chosen = rng.integers(len(sizes), size=len(sizes))
        if sd is None:
            times = np.bincount(chosen, minlength=len(sizes))
            held = times > 0
            found[draw] = _of_sorted(sizes[held], (times * weights)[held], percents)
        else:
            moved = _moved(sizes[chosen], sd[chosen], rng)
            found[draw] = percentiles(moved, (moved / sizes[-1]) ** power, percents)
    return np.asarray(found * np.exp(common_sd * rng.standard_normal((draws, 1))))


def _moved(sizes: Floats, sd: Floats, rng: np.random.Generator) -> Floats:
    """Sizes moved by their standard uncertainty, lognormal with the mean kept; NaN is none."""
    spread = np.sqrt(np.log1p(np.nan_to_num(sd / sizes) ** 2))
    return np.asarray(sizes * np.exp(spread * rng.standard_normal(len(sizes)) - spread**2 / 2))


def interval(draws: Floats, level: float = 0.95) -> Floats:
    """Ends (2, …) of the central share of bootstrap draws (draws, …)."""
    return np.asarray(np.quantile(draws, [(1 - level) / 2, (1 + level) / 2], axis=0))
