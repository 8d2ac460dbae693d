"""Claims and scores of pebbles: what larger pixels leave of each measure's level and order."""

from collections.abc import Sequence

import numpy as np

from validation.arrays import Floats
from validation.kinds.pebbles.spec import PebblesExperiment
from validation.peers import MeasureSpec
from validation.scores.agreement import Statistic, tau, weighted_mean
from validation.scores.define import define
from validation.scores.expectations import Claim, columns_of, rock_claim
from validation.scores.score import Definition, Estimate
from validation.selfcheck.feeds import CLAIMED as FEEDS
from validation.statistics import Block, within_views
from validation.statistics.weighted import median

__all__ = ["FEEDS", "STATISTICS", "claims", "definitions", "ranked_claims", "view_claims"]


def _change(blocks: Sequence[Block]) -> Estimate:
    """Median here less that at full resolution, of pebbles with both values."""
    pairs = _pairs(blocks)
    coarse, full = pairs[:, np.isfinite(pairs).all(axis=0)]
    if coarse.size == 0:
        return Estimate(float("nan"), 0)

    def change(weights: Floats) -> Floats:
        return median(coarse, weights) - median(full, weights)

    value = float(np.median(coarse) - np.median(full))
    return Estimate(value, int(coarse.size), int(coarse.size), change)


def _answered(blocks: Sequence[Block]) -> Estimate:
    """Share of the pebbles with a value at full resolution that have one here."""
    return weighted_mean(np.isfinite(_pairs(blocks)[0]).astype(np.float64))


def _pairs(blocks: Sequence[Block]) -> Floats:
    """Values here and at full resolution, (2, pebbles) of all pictures."""
    pairs = [np.stack([block.values[0], block.truth]) for block in blocks]
    return np.concatenate([np.empty((2, 0)), *pairs], axis=1)


STATISTICS = (
    Statistic("change", "median less that at full resolution", "", "pebbles", "neither", _change),
    Statistic(
        "tau",
        "order of a picture's pebbles against that at full resolution (Kendall's τ_b)",
        "1",
        "pairs",
        "higher",
        lambda blocks: tau(within_views(blocks)),
    ),
    Statistic(
        "answered",
        "pebbles with a value, of those with one at full resolution",
        "share",
        "pebbles",
        "higher",
        _answered,
    ),
)


def claims(experiment: PebblesExperiment, measures: Sequence[MeasureSpec]) -> tuple[Claim, ...]:
    """Claims of measures that need no range on their own values at full resolution."""
    columns = [
        column
        for column in columns_of(experiment, measures)
        if column.measure is None or not column.measure.needs_range
    ]
    return tuple(
        rock_claim(experiment.name, series, column, truth=column.name, same_quantity=True)
        for series in experiment.series
        for column in columns
    )


def view_claims(
    _experiment: PebblesExperiment,
    _measures: Sequence[MeasureSpec],
) -> tuple[Claim, ...]:
    """None: a pebble's shape is known by its mask alone."""
    return ()


ranked_claims = view_claims


def definitions(
    experiment: PebblesExperiment, measures: Sequence[MeasureSpec]
) -> tuple[Definition, ...]:
    """Scores of an experiment's claims."""
    return tuple(
        define(claim, statistic)
        for claim in claims(experiment, measures)
        for statistic in STATISTICS
    )
