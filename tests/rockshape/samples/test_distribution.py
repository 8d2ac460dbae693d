"""Size distributions held to the closed forms of a lognormal, and their intervals to counting."""

import math

import numpy as np
import pytest
from scipy import stats

from rockshape.samples.folk_ward import PERCENTS, folk_ward
from rockshape.samples.percentiles import bootstrap_percentiles, interval, percentiles
from rockshape.samples.weighting import WEIGHTINGS

MEDIAN, SIGMA = 12.0, 0.5
ASKED = (5.0, 16.0, 50.0, 84.0, 95.0)


def even_lognormal(count: int = 200_001) -> np.ndarray:
    """Sizes at even steps of probability: their percentiles are the law's."""
    return MEDIAN * np.exp(SIGMA * stats.norm.ppf((np.arange(count) + 0.5) / count))


@pytest.mark.parametrize("weighting", WEIGHTINGS.values(), ids=WEIGHTINGS)
def test_weighting_by_a_power_moves_the_median_by_its_law(weighting) -> None:
    # D^p times a lognormal's density is one of median m·exp(pσ²) and the same σ
    sizes = even_lognormal()
    found = percentiles(sizes, weighting.weights(sizes), ASKED)
    law = MEDIAN * np.exp(
        weighting.power * SIGMA**2 + SIGMA * stats.norm.ppf(np.array(ASKED) / 100)
    )
    assert found == pytest.approx(law, rel=0.005)


def test_percentiles_of_few_grains_by_hand() -> None:
    # middles of equal weights lie at 1/6, 1/2 and 5/6
    sizes = np.array([8.0, 2.0, 4.0])
    found = percentiles(sizes, np.ones(3), (10, 50, 100 * 2 / 3, 99))
    assert found == pytest.approx([2, 4, math.sqrt(4 * 8), 8])


def test_folk_and_ward_of_a_lognormal() -> None:
    sizes = MEDIAN * np.exp(SIGMA * stats.norm.ppf(np.array(PERCENTS) / 100))
    found = folk_ward(sizes)
    phi = SIGMA / math.log(2)  # standard deviation in φ
    z16, z5 = stats.norm.ppf([0.84, 0.95])
    assert found.mean_phi == pytest.approx(-math.log2(MEDIAN))
    assert found.sorting_phi == pytest.approx(phi * (2 * z16 / 4 + 2 * z5 / 6.6))
    assert found.skewness == pytest.approx(0, abs=1e-12)
    assert found.kurtosis == pytest.approx(1.0, abs=0.01)  # 1 by its making
    assert found.sorting_class == "moderately sorted"
    assert found.skewness_class == "near symmetrical"


def test_a_tail_of_coarse_grains_is_coarse_skewed() -> None:
    finer = np.array([4.0, 5.0, 5.5, 6.0, 8.0, 16.0, 64.0])
    assert folk_ward(finer).skewness < -0.3
    assert folk_ward(finer).skewness_class == "strongly coarse skewed"


def test_intervals_of_the_median_cover_it() -> None:
    covered = 0
    for seed in range(300):
        rng = np.random.default_rng([10_000, seed])
        sizes = MEDIAN * np.exp(SIGMA * rng.standard_normal(80))
        draws = bootstrap_percentiles(sizes, 0.0, (50.0,), sd=None, draws=200)
        low, high = interval(draws)[:, 0]
        covered += low <= MEDIAN <= high
    assert 0.91 <= covered / 300 <= 0.98


def test_uncertain_sizes_widen_the_interval_and_certain_ones_do_not() -> None:
    sizes = np.random.default_rng(10_000).lognormal(2.0, 0.3, 200)
    plain = np.ptp(interval(bootstrap_percentiles(sizes, 2.0, (84.0,), sd=None)))
    certain = np.ptp(interval(bootstrap_percentiles(sizes, 2.0, (84.0,), sd=0 * sizes)))
    vague = np.ptp(interval(bootstrap_percentiles(sizes, 2.0, (84.0,), sd=0.8 * sizes)))
    assert certain == pytest.approx(plain, rel=0.3)  # of other draws
    assert vague > 1.5 * plain


def test_what_moves_all_sizes_alike_widens_intervals_by_its_own_spread() -> None:
    sizes = even_lognormal(100_001)  # so many that counting tells next to nothing
    draws = bootstrap_percentiles(sizes, 0.0, (16.0, 84.0), sd=None, common_sd=0.1, draws=2000)
    assert np.std(np.log(draws), axis=0) == pytest.approx(0.1, rel=0.05)
    assert np.corrcoef(np.log(draws).T)[0, 1] > 0.99
