"""Weighted statistics: many draws at once against one at a time, and against repeated rocks."""

import numpy as np
import pandas as pd
import pytest

from validation.scores.object_scores import f1, of_matched, share_of
from validation.scores.score import score_rng
from validation.scores.scoring import definitions
from validation.statistics import (
    Block,
    across_views,
    share_in_order,
    tau_b,
    weighted_share_in_order,
    weighted_tau_b,
    within_views,
)
from validation.statistics.interval import bootstrap_interval, draws_of, in_draws
from validation.statistics.weighted import lower_median, mean, median, square_sum

ROUNDING = 1e-12  # relative: sums of at most a few hundred terms
NONE = np.zeros(9)
SCENE = ("scene",)


@pytest.fixture
def draws(rng) -> np.ndarray:
    """Draws of nine rocks, so many that they come in several batches."""
    return draws_of(9, rng=rng, replicates=120)


@pytest.mark.parametrize(
    ("statistic", "of_repeated"),
    [
        (mean, np.mean),
        (median, np.median),
        (square_sum, lambda values: values.size * values.var()),
        (lower_median, lambda values: np.quantile(values, 0.5, method="inverted_cdf")),
    ],
)
def test_a_weight_repeats_a_value(statistic, of_repeated, draws, rng) -> None:
    values = rng.normal(size=9)
    found = in_draws(lambda weights: statistic(values, weights), draws)
    expected = [of_repeated(np.repeat(values, draw)) for draw in draws]
    assert found == pytest.approx(expected, rel=ROUNDING)
    assert np.isnan(statistic(values, NONE[None])).all()


def test_a_weight_repeats_a_rock(draws, rng) -> None:
    values, truth = rng.integers(0, 5, (3, 9)).astype(float), rng.integers(0, 5, 9).astype(float)
    block = Block(values=values, truth=truth)
    tau = in_draws(lambda weights: weighted_tau_b(within_views([block]), weights), draws)
    share = in_draws(lambda weights: weighted_share_in_order(across_views([block]), weights), draws)
    for draw, one_tau, one_share in zip(draws, tau, share, strict=True):
        repeated = Block(values=np.repeat(values, draw, axis=1), truth=np.repeat(truth, draw))
        assert one_tau == pytest.approx(tau_b(within_views([repeated])), rel=ROUNDING)
        assert one_share == pytest.approx(share_in_order(across_views([repeated])), rel=ROUNDING)
    assert np.isnan(weighted_tau_b(within_views([block]), NONE[None])).all()


def test_many_draws_at_once_are_those_one_at_a_time(suite, noise) -> None:
    seen = 0
    for definition in definitions(suite):
        found = definition.compute(noise)
        if found.weighted is None:
            continue
        draws = draws_of(found.rocks, rng=score_rng(definition.name), replicates=120)
        alone = [found.weighted(draw[None].astype(np.float64))[0] for draw in draws]
        together = in_draws(found.weighted, draws)
        assert together == pytest.approx(alone, rel=ROUNDING, abs=ROUNDING, nan_ok=True)
        seen += 1
    assert seen > 50


def test_an_interval_is_that_of_a_plain_loop(rng) -> None:
    sample = rng.normal(size=30)
    found = bootstrap_interval(
        lambda weights: mean(sample, weights), 30, rng=np.random.default_rng(7), replicates=500
    )
    plain = np.random.default_rng(7).multinomial(30, np.full(30, 1 / 30), size=500)
    means = [np.mean(np.repeat(sample, draw)) for draw in plain]
    assert found == pytest.approx(np.quantile(means, [0.025, 0.975]), rel=ROUNDING)


def test_objects_are_drawn_with_their_scenes(rng) -> None:
    status = rng.choice(["matched", "missed", "extra", "view"], 200)
    records = pd.DataFrame(
        {"scene": rng.integers(0, 6, 200), "status": status, "boundary_px": rng.uniform(0, 3, 200)}
    )
    objects, outlines = (
        share_of(f1, SCENE)(records),
        of_matched("boundary_px", median, SCENE)(records),
    )
    draws = draws_of(6, rng=rng, replicates=60)
    found = [in_draws(each.weighted, draws) for each in (objects, outlines)]
    for draw, one_f1, one_median in zip(draws, *found, strict=True):
        drawn = pd.concat([records[records["scene"] == s] for s in np.repeat(range(6), draw)])
        matched, missed, extra = (
            (drawn["status"] == s).sum() for s in ("matched", "missed", "extra")
        )
        assert one_f1 == pytest.approx(2 * matched / (2 * matched + missed + extra), rel=ROUNDING)
        own = drawn.loc[drawn["status"] == "matched", "boundary_px"]
        assert one_median == pytest.approx(own.median(), rel=ROUNDING)


def test_draws_of_one_rock_have_no_spread(rng) -> None:
    values = rng.uniform(1, 2, 40)
    assert square_sum(values, 3.0 * np.eye(40)).tolist() == [0.0] * 40
    apart = np.array([1.0, 1.0 + 1e-12])
    assert square_sum(apart, np.ones((1, 2)))[0] == pytest.approx(5e-25, rel=1e-3)
