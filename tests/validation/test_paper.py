"""The paper's own tables through our statistics: every printed figure."""

import pytest

from validation import statistics
from validation.paper import consistency_table, garden_correlation, garden_table, ranking_table

THREE_DIGITS = 5.1e-4  # half a unit of the third decimal, and rounding


@pytest.mark.parametrize(
    ("number", "cvs", "means", "icc", "counts"),
    [
        (1, [0.211, 0.191, 0.127], (0.176, 0.123), (0.598, 0.674), (43, 48)),
        (2, [0.566, 0.389, 0.442], (0.465, 0.162), (0.735, 0.940), (42, 48)),
        (3, [1.326, 1.233, 0.773], (1.111, 0.364), (0.252, 0.763), (20, 27)),
    ],
)
def test_tables_1_to_3(number, cvs, means, icc, counts) -> None:
    blocks = [consistency_table(number).block]
    assert statistics.kendall_w(blocks) == 1.0
    views = blocks[0].values.shape[0]
    assert statistics.concordance(blocks).p_value() == pytest.approx(1 / 6 ** (views - 1))
    assert statistics.tau_b(statistics.between_views(blocks)) == 1.0
    assert statistics.tau_b(statistics.within_views(blocks)) == 1.0
    found = statistics.coefficients_of_variation(blocks)
    assert found == pytest.approx(cvs, abs=THREE_DIGITS)
    normalised = statistics.coefficients_of_variation(statistics.divide_by_view_means(blocks))
    assert (found.mean(), normalised.mean()) == pytest.approx(means, abs=THREE_DIGITS)
    correlation = statistics.intraclass_correlation(blocks)
    assert (correlation.icc_2_1, correlation.icc_3_1) == pytest.approx(icc, abs=THREE_DIGITS)
    pairs = statistics.across_views(blocks)
    assert (pairs.right, pairs.decided) == counts
    assert statistics.share_in_order(pairs) == pytest.approx(counts[0] / counts[1], rel=1e-15)


@pytest.mark.parametrize(
    ("first", "second", "printed"),
    [
        ("eccentricity", "sphericity_2d", 0.80),
        ("ellipse_error", "angularity_3d", 0.61),
        ("ellipsoid_error", "angularity_3d", 0.60),
        ("angularity_2d", "angularity_3d", -0.21),
    ],
)
def test_table_4_correlations(first, second, printed) -> None:
    assert round(garden_correlation(first, second), 2) == printed


def test_table_4_bamm_bamm_moves_from_rank_6_to_35_of_38() -> None:
    ranks = garden_table()["angularity_2d"].rank()
    assert (ranks.loc[13], ranks.loc[18], len(ranks)) == (6, 35, 38)


def test_table_5_is_table_4_in_order() -> None:
    ranked, table = ranking_table(), garden_table()["angularity_3d"]
    assert ranked.is_monotonic_increasing
    assert sorted(ranked.index) == sorted(table.index)
    half_a_unit = 5.1e-3  # table 4 prints two decimals, table 5 three; and rounding
    assert (ranked - table).abs().max() < half_a_unit


def test_no_such_table() -> None:
    with pytest.raises(ValueError, match="1, 2 or 3"):
        consistency_table(4)
