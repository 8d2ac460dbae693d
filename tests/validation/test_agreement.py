"""Agreement statistics: closed cases, invariances, and a second route to each number."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from validation.agreement import (
    Block,
    across_views,
    between_views,
    coefficients_of_variation,
    divide_by_view_means,
    intraclass_correlation,
    kendall_w,
    share_in_order,
    tau_b,
    within_views,
)
from validation.agreement.interval import bootstrap_interval
from validation.errors import InputError

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


def test_coefficient_of_variation() -> None:
    table = block([[1, 2, np.nan], [3, 2, 5]], [1, 2, 3])
    cvs = coefficients_of_variation([table])
    assert cvs[:2] == pytest.approx([np.sqrt(2) / 2, 0.0], abs=ROUNDING)
    assert np.isnan(cvs[2])


def test_a_views_common_factor_is_divided_out() -> None:
    rocks = np.array([1.0, 2.0, 5.0])
    table = block(np.outer([1.0, 3.0, 0.2], rocks), rocks)
    assert coefficients_of_variation(divide_by_view_means([table])) == pytest.approx(
        np.zeros(3), abs=ROUNDING
    )
    assert intraclass_correlation([table]).icc_3_1 == pytest.approx(1.0, abs=ROUNDING)


def test_icc_of_shrout_and_fleiss() -> None:
    # Shrout and Fleiss 1979, table 2: six targets, four judges; table 4 prints .29 and .71.
    judged = np.array(
        [[9, 2, 5, 8], [6, 1, 3, 2], [8, 4, 6, 8], [7, 1, 2, 6], [10, 5, 6, 9], [6, 2, 4, 7]]
    )
    found = intraclass_correlation([block(np.exp(judged.T), np.arange(6))])
    assert round(found.icc_2_1, 2) == 0.29
    assert round(found.icc_3_1, 2) == 0.71


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
            lambda w, sample=sample: float(w @ sample / w.sum()), 30, rng=rng, replicates=200
        )
        hits += low <= 0.0 <= high
    assert 0.89 <= hits / 400 <= 0.99


def test_bootstrap_of_pairs_never_pairs_a_rock_with_itself() -> None:
    pairs = within_views([block([[1, 2, 3], [1, 2, 3]], [1, 2, 3])])
    interval = bootstrap_interval(
        lambda w: tau_b(pairs, w), pairs.rocks, rng=np.random.default_rng(0)
    )
    assert interval == (1.0, 1.0)


def test_bootstrap_of_one_rock_is_nan() -> None:
    low, high = bootstrap_interval(lambda _: 1.0, 1, rng=np.random.default_rng(0))
    assert np.isnan(low)
    assert np.isnan(high)
