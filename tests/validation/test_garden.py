"""A field seen frame by frame: which measures go together, and the paper's tables 4 and 5."""

import msgspec
import numpy as np
import pytest
from scipy import stats

from validation.kinds.garden.scores import COUPLES, column_of, definitions, is_garden, rho_key
from validation.kinds.scoring import score_records
from validation.paper import GARDEN_COLUMNS, garden_rank_move, garden_table
from validation.suite.experiments import YardExperiment

ROUNDING = 1e-12


@pytest.fixture(scope="module")
def field(suite) -> YardExperiment:
    experiment = suite.experiments[0]
    table = msgspec.to_builtins(experiment.scene)
    table["views"]["path"], table["population"]["kind"] = "pan", "golombek-rapp"
    scene = msgspec.convert(table, type(experiment.scene))
    return msgspec.structs.replace(experiment, scene=scene)


def test_a_pan_is_a_garden(suite, field) -> None:
    assert is_garden(field)
    assert not any(is_garden(e) for e in suite.experiments if isinstance(e, YardExperiment))


def test_rho_is_spearmans(suite, field, noise) -> None:
    own = noise[(noise["experiment"] == field.name)]
    with_field = msgspec.structs.replace(suite, experiments=(field,), gates=())
    scores = {score.name: score for score in score_records(with_field, own)}
    for couple in COUPLES:
        score = scores[rho_key(field.name, "paper", couple).name]
        expected = stats.spearmanr(own[couple.first], own[couple.second]).statistic
        assert score.value == pytest.approx(expected, abs=ROUNDING)
        assert score.low < score.value < score.high
        assert score.count == len(own)


def test_rho_without_values_is_nan(field, noise) -> None:
    empty = noise.assign(angularity_3d_per_m=np.nan)
    found = {d.name: d.compute(empty) for d in definitions(field)}
    assert np.isnan(found[rho_key(field.name, "paper", COUPLES[1]).name].value)


def test_the_robust_columns_stand_for_the_papers() -> None:
    assert column_of("robust", "ellipse_error_px2") == "ellipse_error"
    assert column_of("robust", "angularity_3d_per_m") == "angularity_3d"
    assert column_of("paper", "axis_ratio") == "axis_ratio"


def test_rocks_seen_twice_in_table_4() -> None:
    # 2-D angularity of Bamm-Bamm goes from rank 6 to rank 35 of 38.
    table = garden_table()
    assert set(GARDEN_COLUMNS.values()) == set(table.columns) - {"name"}
    ranks = table["angularity_2d"].rank()
    assert (ranks[13], ranks[18]) == (6, 35) or (ranks[18], ranks[13]) == (6, 35)
    flat_top = abs(ranks[28] - ranks[33])
    assert garden_rank_move("angularity_2d") == pytest.approx((29 + flat_top) / 2 / 38)
