"""Agreement statistics: closed cases, invariances, and a second route to each number."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from validation.errors import InputError
from validation.statistics import (
    Block,
    across_views,
    between_views,
    coefficients_of_variation,
    concordance,
    divide_by_view_means,
    intraclass_correlation,
    kendall_w,
    rank_moves,
    share_in_order,
    spreads_over_views,
    tau_b,
    weighted_tau_b,
    weighted_within_over_between,
    within_views,
)
from validation.statistics.interval import bootstrap_interval

ROUNDING = 1e-12  # sums of at most a few hundred terms of order one

# Few distinct integers, so that ties are frequent.
ranks = st.lists(st.tuples(st.integers(0, 4), st.integers(0, 4)), min_size=3, max_size=12)


def block(values, truth) -> Block:
    return Block(values=np.atleast_2d(np.asarray(values, float)), truth=np.asarray(truth, float))


@given(ranks)
@settings(max_examples=200, deadline=None)
def test_tau_b_of_one_view_is_scipys(pairs) -> None:
    truth, values = np.array(pairs).T
    ours = tau_b(within_views([block(values, truth)]))
    if len(set(truth)) == 1 or len(set(values)) == 1:
        assert np.isnan(ours)
    else:
        assert ours == pytest.approx(stats.kendalltau(truth, values).statistic, abs=ROUNDING)


@given(ranks, st.permutations(range(3)))
@settings(max_examples=50, deadline=None)
def test_order_of_rocks_and_views_is_of_no_account(pairs, views) -> None:
    truth, values = np.array(pairs, float).T
    table = np.array([values, truth, values + truth])
    one, other = block(table, truth), block(table[list(views)][:, ::-1], truth[::-1])
    for statistic in (
        lambda b: tau_b(within_views([b])),
        lambda b: share_in_order(across_views([b])),
        lambda b: kendall_w([b]),
    ):
        assert statistic(one) == pytest.approx(statistic(other), abs=ROUNDING, nan_ok=True)


def test_pooled_tau_counts_pairs_not_scenes() -> None:
    four_right = block([1, 2, 3, 4], [1, 2, 3, 4])  # 6 concordant pairs
    two_wrong = block([2, 1], [1, 2])  # 1 discordant pair
    assert tau_b(within_views([four_right, two_wrong])) == pytest.approx(5 / 7, abs=ROUNDING)


def test_pairs_across_views_pair_every_view_with_every_view() -> None:
    pairs = across_views([block([[1, 2], [10, 20]], [1, 2])])
    assert (pairs.decided, pairs.right) == (4, 3)  # rock 1 at 10 beats rock 2 at 2
    assert share_in_order(pairs) == 0.75


def test_margins() -> None:
    table = block([[1.0, 1.05, 3.0]], [0.0, 1.0, 1.1])
    exact = within_views([table])
    assert (exact.decided, exact.right) == (3, 3)
    loose = within_views([table], value_margin=0.1)
    assert (loose.decided, loose.right) == (3, 2)
    assert share_in_order(loose) == pytest.approx(2.5 / 3, abs=ROUNDING)  # the tie counts one half
    assert within_views([table], truth_margin=0.2).decided == 2


def test_unmeasured_rocks_are_left_out_of_pairs() -> None:
    pairs = within_views([block([[1, np.nan, 3], [1, 2, 3]], [1, 2, 3])])
    assert pairs.decided == 1 + 3


def test_nothing_to_order_is_nan() -> None:
    assert np.isnan(tau_b(within_views([])))
    assert np.isnan(tau_b(within_views([block([5, 5], [1, 2])])))
    assert np.isnan(share_in_order(within_views([block([1, 2], [3, 3])])))
    assert np.isnan(kendall_w([block([[1, 2]], [1, 2])]))


def test_kendall_w_is_friedmans_chi_square() -> None:
    values = np.random.default_rng(1).integers(0, 5, (4, 6)).astype(float)
    chi_square = stats.friedmanchisquare(*values.T).statistic  # = m (n − 1) W, with ties
    w = kendall_w([block(values, np.zeros(6))])
    assert w == pytest.approx(chi_square / (4 * 5), abs=ROUNDING)


def test_kendall_w_ends() -> None:
    same = block([[1, 2, 3], [10, 20, 30]], [1, 2, 3])
    opposite = block([[1, 2, 3], [3, 2, 1]], [1, 2, 3])
    assert kendall_w([same]) == 1.0
    assert kendall_w([opposite]) == 0.0
    assert kendall_w([same, opposite]) == 0.5
    assert tau_b(between_views([same])) == 1.0
    assert tau_b(between_views([opposite])) == -1.0


def test_kendall_w_of_weighted_rocks_is_that_of_repeated_ones() -> None:
    rng = np.random.default_rng(2)
    blocks = [block(rng.integers(0, 4, (3, n)), np.zeros(n)) for n in (5, 5, 4)]
    weights = rng.integers(0, 3, 14)
    parts = np.split(weights, [5, 10])
    repeated = [
        block(np.repeat(b.values, part, axis=1), np.zeros(part.sum()))
        for b, part in zip(blocks, parts, strict=True)
    ]
    found = concordance(blocks).weighted(weights[None].astype(float))[0]
    assert found == pytest.approx(kendall_w(repeated), abs=ROUNDING)


def test_p_of_perfect_concordance_is_one_arrangement() -> None:
    # Three views: the second and the third must each be the one of six orders that the first has.
    perfect = block([[1, 2, 3]] * 3, [1, 2, 3])
    assert concordance([perfect]).p_value() == pytest.approx(1 / 36)
    assert concordance([perfect, perfect]).p_value() == pytest.approx(1 / 36**2)
    assert concordance([block([[1, 2, 3], [3, 2, 1]], [1, 2, 3])]).p_value() == 1.0


def test_p_of_random_ranks_is_uniform() -> None:
    # Above MAX_ARRANGEMENTS p comes from random ones. The mean of 40 uniform numbers is 0.5 with
    # a standard error of 0.046; the bounds are four of those.
    rng = np.random.default_rng(4)
    found = [concordance([block(rng.random((3, 7)), np.zeros(7))]).p_value() for _ in range(40)]
    assert 0.31 <= np.mean(found) <= 0.69
    same = block([np.arange(8)] * 4, np.arange(8))
    assert concordance([same]).p_value() == 1 / 2000


def test_truth_of_each_view() -> None:
    turned = block([[1, 2], [2, 1]], [[10, 20], [20, 10]])
    assert tau_b(within_views([turned])) == 1.0
    assert share_in_order(across_views([turned])) == 1.0
    assert share_in_order(across_views([block(turned.values, [10, 20])])) == 0.5


def test_coefficient_of_variation() -> None:
    nan = np.nan
    table = block([[1, 2, nan, nan], [3, 2, 5, 1], [nan, nan, nan, 3]], [1, 2, 3, 4])
    cvs = coefficients_of_variation([table])
    assert cvs[[0, 1, 3]] == pytest.approx([np.sqrt(2) / 2, 0.0, np.sqrt(2) / 2], abs=ROUNDING)
    assert np.isnan(cvs[2])


def test_rank_moves() -> None:
    # The ranking of the six rock views is 1 2 3 | 4 5 6: rock 1 goes from 1 to 6, 2 and 3 from
    # 2 to 4 and from 3 to 5.
    moves = rank_moves([block([[1, 2, 3], [9, 4, 5]], [1, 2, 3])])
    assert moves == pytest.approx(np.array([5, 2, 2]) / 6, abs=ROUNDING)
    assert np.isnan(rank_moves([block([[1, 2], [np.nan, 3]], [1, 2])])[0])


def test_rank_moves_of_independent_values_are_a_third() -> None:
    values = np.random.default_rng(6).random((2, 20000))
    # |u − v| of uniform numbers has mean 1/3 and deviation 0.236: 0.0017 for 20000, six of those.
    assert rank_moves([block(values, np.zeros(20000))]).mean() == pytest.approx(1 / 3, abs=0.01)


def within_over_between(blocks) -> float:
    spreads = spreads_over_views(blocks)
    return float(weighted_within_over_between(spreads, np.ones((1, spreads.mean.size)))[0])


def test_spread_within_a_rock_over_that_between() -> None:
    # Means 2, 8 and 5, variance 9; variances 2, 8 and 2, mean 4. A rock of one view does not count.
    two = block([[1, 6, 4, 7], [3, 10, 6, np.nan]], np.zeros(4))
    assert within_over_between([two]) == pytest.approx(2 / 3, abs=ROUNDING)
    parts = [block(two.values[:, rocks], np.zeros(2)) for rocks in ([0, 3], [1, 2])]
    assert within_over_between(parts) == pytest.approx(2 / 3, abs=ROUNDING)
    weights = np.array([[2.0, 1.0, 0.0, 5.0]])  # means 2, 2 and 8: variance 12; variances' mean 4
    found = weighted_within_over_between(spreads_over_views([two]), weights)
    assert found == pytest.approx(np.sqrt(4 / 12), abs=ROUNDING)


def test_spread_of_independent_values_is_the_root_of_the_views() -> None:
    values = np.random.default_rng(7).normal(size=(4, 20000))
    # The ratio of variances has a standard error of 1.1 %, and its root half of that.
    assert within_over_between([block(values, np.zeros(20000))]) == pytest.approx(2.0, abs=0.05)


def test_a_views_common_factor_is_divided_out() -> None:
    rocks = np.array([1.0, 2.0, 5.0])
    table = block(np.outer([1.0, 3.0, 0.2], rocks), rocks)
    assert coefficients_of_variation(divide_by_view_means([table])) == pytest.approx(
        np.zeros(3), abs=ROUNDING
    )
    assert intraclass_correlation([table]).icc_3_1 == pytest.approx(1.0, abs=ROUNDING)


def test_icc_of_shrout_and_fleiss() -> None:
    # Shrout and Fleiss 1979, table 2: six targets, four judges; table 4 prints .29 and .71. Their
    # intervals as McGraw and Wong's and Shrout and Fleiss's formulas give them elsewhere.
    judged = np.array(
        [[9, 2, 5, 8], [6, 1, 3, 2], [8, 4, 6, 8], [7, 1, 2, 6], [10, 5, 6, 9], [6, 2, 4, 7]]
    )
    found = intraclass_correlation([block(np.exp(judged.T), np.arange(6))])
    assert round(found.icc_2_1, 2) == 0.29
    assert round(found.icc_3_1, 2) == 0.71
    assert np.round(found.icc_2_1_interval, 2).tolist() == [0.02, 0.76]
    assert np.round(found.icc_3_1_interval, 2).tolist() == [0.34, 0.95]


def test_icc_intervals_cover() -> None:
    # 95 % of 300 intervals hold the true ICC of 0.8 (rocks' variance 4, the rest's 1; for ICC(2,1)
    # the views' 0.25 makes it 4/5.25); the standard error is 1.3 %, five of those are left.
    rng = np.random.default_rng(5)
    hits = np.zeros(2)
    for _ in range(300):
        rocks, views = rng.normal(0, 2, 12), rng.normal(0, 0.5, (4, 1))
        found = intraclass_correlation(
            [block(np.exp(rocks + views + rng.normal(size=(4, 12))), np.zeros(12))]
        )
        hits += [
            low <= true <= high
            for (low, high), true in (
                (found.icc_2_1_interval, 4 / 5.25),
                (found.icc_3_1_interval, 0.8),
            )
        ]
    assert (hits / 300 >= 0.885).all()


@pytest.mark.parametrize(
    "logs", [[[0, 10], [5, 5], [10, 0]], [[0, 1, 0], [1, 0, 1]], [[0, 0, 0], [1, 1, 1]]]
)
def test_icc_has_both_ends_of_an_interval_or_none(logs) -> None:
    found = intraclass_correlation([block(np.exp(logs), np.zeros(len(logs[0])))])
    for ends in (found.icc_2_1_interval, found.icc_3_1_interval):
        assert np.isfinite(ends).all() or np.isnan(ends).all()


def test_icc_needs_positive_values() -> None:
    assert np.isnan(intraclass_correlation([block([[1, 2], [0, 3]], [1, 2])]).icc_2_1)


def test_block_refuses_shapes_that_do_not_belong() -> None:
    with pytest.raises(InputError, match="found"):
        block([[1, 2, 3]], [1, 2])


def test_bootstrap_covers_a_mean() -> None:
    # 95 % of 400 intervals should hold the true mean; the percentile interval of 30 values is a
    # little short (about 94 %), and 400 trials have a standard error of 1.1 %: 89 % is five off.
    rng = np.random.default_rng(3)
    hits = 0
    for _ in range(400):
        sample = rng.normal(size=30)
        low, high = bootstrap_interval(
            lambda w, sample=sample: w @ sample / w.sum(axis=1), 30, rng=rng, replicates=200
        )
        hits += low <= 0.0 <= high
    assert 0.89 <= hits / 400 <= 0.99


def test_bootstrap_of_pairs_never_pairs_a_rock_with_itself() -> None:
    pairs = within_views([block([[1, 2, 3], [1, 2, 3]], [1, 2, 3])])
    interval = bootstrap_interval(
        lambda w: weighted_tau_b(pairs, w), pairs.rocks, rng=np.random.default_rng(0)
    )
    assert interval == (1.0, 1.0)


def test_bootstrap_of_one_rock_is_nan() -> None:
    low, high = bootstrap_interval(lambda w: w[:, 0], 1, rng=np.random.default_rng(0))
    assert np.isnan(low)
    assert np.isnan(high)
