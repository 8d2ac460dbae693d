"""A field seen frame by frame: which measures go together, and the paper's tables 4 and 5."""

import msgspec
import numpy as np
import pytest
from scipy import stats

from validation.errors import InputError
from validation.kinds.garden.judge import COUPLES, correlations, rho_key
from validation.kinds.garden.spec import GardenExperiment
from validation.paper import GARDEN_COLUMNS, garden_rank_move, garden_table
from validation.scores.scoring import score_records
from validation.scores.titles import column_of
from validation.suite.suite import as_suite, load_suite

ROUNDING = 1e-12


@pytest.fixture(scope="module")
def field(suite) -> GardenExperiment:
    table = msgspec.to_builtins(suite.experiments[0])
    table["scene"]["views"]["path"] = "pan"
    table["scene"]["population"]["kind"] = "golombek-rapp"
    return msgspec.convert(table | {"kind": "garden"}, GardenExperiment)


def test_an_older_table_of_a_pan_is_read_as_a_garden() -> None:
    whole = msgspec.to_builtins(load_suite("garden"))
    (table,) = whole["experiment"]
    assert table["kind"] == "garden"
    assert as_suite(whole | {"experiment": [table | {"kind": "yard"}]}, where="old") == load_suite(
        "garden"
    )
    with pytest.raises(InputError, match=r"scene.views.path: expected 'pan', found 'drive-by'"):
        views = table["scene"]["views"] | {"path": "drive-by"}
        scene = table["scene"] | {"views": views}
        as_suite(whole | {"experiment": [table | {"scene": scene}]}, where="s")


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
    found = {d.name: d.compute(empty) for d in correlations(field)}
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
