"""The scores of one measure over several views: the statistics of the paper's tables 1 to 3."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from validation.arrays import Floats
from validation.scores.score import Better, Estimate
from validation.statistics import (
    Block,
    Pairs,
    across_views,
    between_views,
    coefficients_of_variation,
    concordance,
    divide_by_view_means,
    intraclass_correlation,
    rank_moves,
    share_in_order,
    spreads_over_views,
    tau_b,
    weighted_share_in_order,
    weighted_tau_b,
    weighted_within_over_between,
    within_views,
)
from validation.statistics.interval import of_sample
from validation.statistics.weighted import mean


@dataclass(frozen=True)
class Statistic:
    """A statistic of blocks; ours and the paper's go through the same `compute`."""

    key: str
    title: str
    unit: str
    counted: str
    better: Better
    compute: Callable[[Sequence[Block]], Estimate]


def tau(pairs: Pairs) -> Estimate:
    """Kendall's τ_b of pooled pairs, ready to be weighted by rock."""
    return Estimate(tau_b(pairs), pairs.decided, pairs.rocks, partial(weighted_tau_b, pairs))


def _share(pairs: Pairs) -> Estimate:
    weighted = partial(weighted_share_in_order, pairs)
    return Estimate(share_in_order(pairs), pairs.decided, pairs.rocks, weighted)


def weighted_mean(values: Floats) -> Estimate:
    """Mean of the finite values, one value a rock."""
    values = values[np.isfinite(values)]
    if values.size == 0:
        return Estimate(float("nan"), 0)

    return Estimate(float(values.mean()), int(values.size), int(values.size), partial(mean, values))


def _within_over_between(blocks: Sequence[Block]) -> Estimate:
    spreads = spreads_over_views(blocks)
    weighted, rocks = partial(weighted_within_over_between, spreads), spreads.mean.size
    counted = int(np.isfinite(spreads.mean).sum())
    return Estimate(of_sample(weighted, rocks), counted, rocks, weighted)


def _concordance(blocks: Sequence[Block]) -> Estimate:
    found = concordance(blocks)
    complete = sum(block.complete().shape[1] for block in blocks)
    return Estimate(found.w, complete, found.rocks, found.weighted, p_value=found.p_value)


def _agreement(blocks: Sequence[Block]) -> Estimate:
    found = intraclass_correlation(blocks)
    return Estimate(found.icc_2_1, found.rocks, interval=found.icc_2_1_interval)


def _consistency(blocks: Sequence[Block]) -> Estimate:
    found = intraclass_correlation(blocks)
    return Estimate(found.icc_3_1, found.rocks, interval=found.icc_3_1_interval)


ORDERS = (
    Statistic(
        "tau",
        "order within a view against the truth (Kendall's τ_b)",
        "1",
        "pairs",
        "higher",
        lambda blocks: tau(within_views(blocks)),
    ),
    Statistic(
        "pairs_across",
        "pairs in the right order across views",
        "share",
        "pairs",
        "higher",
        lambda blocks: _share(across_views(blocks)),
    ),
)
STATISTICS = (
    *ORDERS,
    Statistic(
        "kendall_w",
        "agreement of the views' rankings (Kendall's W)",
        "1",
        "rocks",
        "higher",
        _concordance,
    ),
    Statistic(
        "tau_views",
        "agreement between two views (mean pairwise τ_b)",
        "1",
        "pairs",
        "higher",
        lambda blocks: tau(between_views(blocks)),
    ),
    Statistic(
        "cv",
        "coefficient of variation across views, mean over rocks",
        "1",
        "rocks",
        "lower",
        lambda blocks: weighted_mean(coefficients_of_variation(blocks)),
    ),
    Statistic(
        "cv_normalised",
        "the same after dividing by each view's mean",
        "1",
        "rocks",
        "lower",
        lambda blocks: weighted_mean(coefficients_of_variation(divide_by_view_means(blocks))),
    ),
    Statistic(
        "within_over_between",
        "standard deviation within a rock over that of the rocks' means",
        "1",
        "rocks",
        "lower",
        _within_over_between,
    ),
    Statistic(
        "rank_move",
        "move of a rock's rank between two views, share of the ranking",
        "1",
        "rocks",
        "lower",
        lambda blocks: weighted_mean(rank_moves(blocks)),
    ),
    Statistic(
        "icc_2_1",
        "agreement of values: ICC(2,1) on logs",
        "1",
        "rocks",
        "higher",
        _agreement,
    ),
    Statistic(
        "icc_3_1",
        "consistency of values: ICC(3,1) on logs",
        "1",
        "rocks",
        "higher",
        _consistency,
    ),
)
