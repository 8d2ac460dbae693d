"""Abundance fitted to fields that a Golombek–Rapp law has drawn."""

import numpy as np
import pytest
from scipy import integrate

from rockshape.samples.abundance import decay_per_m, fit_abundance, rocks_per_m2

AREA_M2, LEAST_M = 100.0, 0.05


def drawn(k: float, seed: int) -> np.ndarray:
    """Diameters of a field: a Poisson number, each by the inverse of the number law."""
    rng = np.random.default_rng([10_000, seed])
    grid = np.geomspace(LEAST_M, 4.0, 4000)
    above = np.array([rocks_per_m2(k, each) for each in grid])
    count = rng.poisson(AREA_M2 * above[0])
    return np.interp(rng.uniform(size=count), 1 - above / above[0], grid)


def test_the_number_of_rocks_is_the_integral_of_the_covered_share() -> None:
    k = 0.19
    q = decay_per_m(k)
    density = lambda d: 4 * q * k * np.exp(-q * d) / (np.pi * d**2)  # noqa: E731
    expected, _ = integrate.quad(density, LEAST_M, np.inf)
    assert rocks_per_m2(k, LEAST_M) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("k", [0.03, 0.19])
def test_intervals_cover_the_law_that_drew_the_field(k: float) -> None:
    fits = [fit_abundance(drawn(k, each), area_m2=AREA_M2, least_m=LEAST_M) for each in range(60)]
    assert np.mean([fit.k for fit in fits]) == pytest.approx(k, rel=0.06)
    covered = sum(fit.low <= k <= fit.high for fit in fits)
    assert covered >= 53  # of 60: 57 expected, fewer than 53 in two of a hundred runs


def test_the_covered_share_is_that_of_discs() -> None:
    fit = fit_abundance(np.full(10, 0.5), area_m2=AREA_M2, least_m=LEAST_M)
    assert fit.covered == pytest.approx(10 * np.pi / 4 * 0.25 / AREA_M2)
    assert fit.rocks == 10
