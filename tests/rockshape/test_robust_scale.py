"""Robust scales: consistent for normal residuals, and held by few spoiled ones."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from rockshape.numerics.robust_scale import (
    BIWEIGHT_CUT,
    BIWEIGHT_MEAN,
    MEDIAN_TO_SIGMA,
    biweight_scale,
    median_scale,
)


def test_the_constants_make_both_the_standard_deviation_of_normal_residuals() -> None:
    assert pytest.approx(1 / norm.ppf(0.75), rel=1e-7) == MEDIAN_TO_SIGMA
    cut = BIWEIGHT_CUT
    within = quad(lambda z: (1 - (1 - (z / cut) ** 2) ** 3) * norm.pdf(z), -cut, cut)[0]
    assert within + 2 * norm.sf(cut) == pytest.approx(BIWEIGHT_MEAN, abs=1e-6)
    normal = 3 * norm.ppf((np.arange(4000) + 0.5) / 4000)
    assert median_scale(normal) == pytest.approx(3, rel=1e-3)
    assert biweight_scale(normal) == pytest.approx(3, rel=1e-3)


@pytest.mark.parametrize("spoilt", [2.0, 5.0, 100.0, 1e9])
def test_two_in_a_hundred_spoiled_residuals_move_it_little(spoilt: float) -> None:
    normal = norm.ppf((np.arange(5000) + 0.5) / 5000)
    mixed = np.random.default_rng(0).permutation(normal)
    mixed[:100] = spoilt
    assert biweight_scale(mixed) == pytest.approx(1, abs=0.045)


def test_scales_grow_with_the_residuals_and_have_none_without_any() -> None:
    residuals = np.random.default_rng(1).standard_t(3, 500)
    assert biweight_scale(-7 * residuals) == pytest.approx(7 * biweight_scale(residuals))
    assert np.isnan(biweight_scale(np.empty(0)))
    assert biweight_scale(np.zeros(9)) == 0
