"""Assertions for anyone's tests: what passes, what fails, and that a failure names the rocks."""

import numpy as np
import pandas as pd
import pytest
from scipy import stats

from validation.errors import InputError
from validation.testing import assert_consistent, assert_ranks
from validation.testing.tables import MAX_LISTED


def _said(check, *args, **kwargs) -> str:
    with pytest.raises(AssertionError) as failure:
        check(*args, **kwargs)
    return str(failure.value)


def test_an_order_like_the_truths_passes() -> None:
    assert_ranks([1.0, 2.0, 3.0, 9.0], [0.1, 0.2, 0.3, 0.4], at_least=1.0)
    assert_ranks(np.arange(5), np.arange(5) ** 2)
    with pytest.raises(AssertionError):
        assert_ranks([3.0, 2.0, 1.0], [0.1, 0.2, 0.3], at_least=-0.9)


def test_the_bound_is_on_kendalls_tau_b(rng) -> None:
    truth, values = rng.normal(size=20), rng.integers(0, 5, size=20)
    tau = stats.kendalltau(values, truth).statistic
    assert_ranks(values, truth, at_least=tau - 1e-9)
    assert f"found {tau:.3f}" in _said(assert_ranks, values, truth, at_least=tau + 1e-9)


def test_a_failure_lists_the_pairs_out_of_order_farthest_apart_first() -> None:
    said = _said(
        assert_ranks,
        {"flat": 1.0, "slab": 3.0, "cube": 2.0, "ball": 3.0},
        {"ball": 0.9, "flat": 0.1, "cube": 0.5, "slab": 0.3},
    )
    # 6 pairs: slab-cube reversed, slab-ball tied: τ_b = (4 − 1)/√(6 · 5)
    assert said.splitlines() == [
        "expected Kendall's τ_b ≥ 0.8, found 0.548: of 6 pairs of 4 rocks 2 are out of order",
        "  rocks slab and ball: truth 0.3 < 0.9, but values 3 = 3",
        "  rocks slab and cube: truth 0.3 < 0.5, but values 3 > 2",
    ]


def test_a_long_list_is_cut() -> None:
    lines = _said(assert_ranks, np.arange(8)[::-1], np.arange(8)).splitlines()
    assert len(lines) == 1 + MAX_LISTED + 1
    assert lines[-1] == "  and 18 more"


def test_what_was_not_measured_fails_unless_allowed() -> None:
    values, truth = [1.0, np.nan, 3.0], [0.1, 0.2, 0.3]
    said = _said(assert_ranks, values, truth)
    assert said.splitlines()[1:] == ["  rock 1: value nan, truth 0.2"]
    assert_ranks(values, truth, allow_missing=True)
    assert "undefined" not in said
    assert "all values" in _said(assert_ranks, [1.0, np.nan], [0.1, 0.2], allow_missing=True)
    assert "all values" in _said(assert_ranks, [1.0, 1.0], [0.1, 0.2])


@pytest.mark.parametrize(
    ("values", "truth", "said"),
    [
        ([1.0], [1.0, 2.0], "found 1 and 2, and in one alone 1"),
        ({"a": 1.0, "b": 2.0}, {"a": 1.0, "c": 2.0}, "in one alone b, c"),
        (["x", "y"], [1.0, 2.0], "values: expected one number a rock"),
        (np.ones((2, 2)), [1.0, 2.0], "values: expected one number a rock"),
        (pd.Series([1.0, 2.0], index=[7, 7]), [1.0, 2.0], "found 7 again"),
    ],
)
def test_values_and_truth_must_be_of_the_same_rocks(values, truth, said) -> None:
    with pytest.raises(InputError, match=said):
        assert_ranks(values, truth)


def test_steady_values_pass_in_every_form() -> None:
    rows = [[1.0, 2.0, np.nan], [1.1, 2.1, 5.0]]
    named = {"a": {1: 1.0, 2: 2.0}, "b": {1: 1.1, 2: 2.1, 3: 5.0}}
    for values in (rows, np.array(rows), pd.DataFrame(rows), named, list(named.values())):
        assert_consistent(values, cv_at_most=0.07, order_at_least=1.0)


def test_a_failure_names_the_rocks_that_vary_and_their_values() -> None:
    values = {"near": {"a": 1.0, "b": 2.0, "c": 3.0}, "far": {"a": 1.1, "b": 4.0, "d": 1.0}}
    cv = np.std([2.0, 4.0], ddof=1) / 3.0
    assert _said(assert_consistent, values, cv_at_most=0.1).splitlines() == [
        "expected a coefficient of variation across views ≤ 0.1, found more for 1 of 2 rocks",
        f"  rock b: {cv:.3f} (2 in view near, 4 in view far)",
    ]
    assert_consistent(values, cv_at_most=cv + 1e-9)


def test_a_mean_that_is_not_positive_has_no_variation_and_fails() -> None:
    said = _said(assert_consistent, [[-1.0, 1.0], [1.0, 1.0]], cv_at_most=1.0)
    assert "rock 0: undefined, as the mean is not positive" in said


def test_a_failure_names_the_pairs_that_views_order_differently() -> None:
    values = [[1.0, 2.0, 3.0], [2.0, 1.0, 3.0], [1.0, 2.0, 3.0]]
    # of 3 pairs of rocks in 3 pairs of views, 0-1 differs in two
    assert _said(assert_consistent, values, order_at_least=0.9).splitlines() == [
        "expected a share of pairs ordered alike by two views ≥ 0.9, found 0.778",
        "  rocks 0 and 1: differently in 2 pairs of views",
    ]
    assert_consistent(values, order_at_least=7 / 9 - 1e-9)


def test_rocks_that_no_two_views_show_are_no_evidence() -> None:
    said = _said(assert_consistent, [[1.0, np.nan], [np.nan, 2.0]], cv_at_most=1.0)
    assert said == "expected rocks that two views show, found none: 2 rocks in 2 views"
    assert "no pair" in _said(assert_consistent, [[1.0], [1.0]], order_at_least=0.0)


def test_a_bound_must_be_given() -> None:
    with pytest.raises(InputError, match="cv_at_most or order_at_least"):
        assert_consistent([[1.0], [1.0]])
