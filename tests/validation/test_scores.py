"""Scores on fabricated records: the oracle is perfect, shuffled truth is not, noise is noise."""

import math

import msgspec
import numpy as np
import pandas as pd
import pytest

from validation.kinds.shapes.judge import gap_shares
from validation.peers import MeasureSpec
from validation.scores.scoring import (
    all_view_claims,
    definitions,
    gate_scores,
    score_records,
    score_values,
)
from validation.selfcheck.oracle import mixed, oracle, shuffled
from validation.suite.gates import Gate, evaluate


def held(suite, records, *, views=False):
    """Hold records to the gates on rocks or on views; a level has no truth."""
    gates = [
        gate
        for gate in suite.gates
        if not gate.score.endswith(".level") and (".view_" in gate.score) == views
    ]
    return evaluate(gates, gate_scores(suite, gates, records))


def test_the_oracle_scores_one(suite, claims, noise, ranking) -> None:
    values = score_values(suite, oracle(noise, claims))
    assert {name: values[name] for name in ranking} == dict.fromkeys(ranking, 1.0)
    assert (values["yard.recall"], values["yard.precision"], values["yard.mean_iou"]) == (1, 1, 1)
    assert values["yard.angularity_2d_deg.kendall_w"] == 1.0
    assert values["yard.angularity_2d_deg.tau_views"] == 1.0
    rounding = 1e-12
    assert values["yard.angularity_2d_deg.cv"] == pytest.approx(0.0, abs=rounding)
    assert values["yard.angularity_2d_deg.within_over_between"] == pytest.approx(0.0, abs=rounding)
    assert values["yard.angularity_2d_deg.icc_2_1"] == pytest.approx(1.0, abs=rounding)
    assert values["shapes.sphericity.axis_ratio.gap_error"] == pytest.approx(0.0, abs=rounding)
    assert values["shapes.sphericity.axis_ratio.error"] == 0.0
    assert values["shapes.roundness.ellipse_error_px2.gap_error"] == pytest.approx(
        0.0, abs=rounding
    )


def test_the_oracle_passes_every_gate_of_the_suite(suite, claims, noise) -> None:
    results = held(suite, oracle(noise, claims))
    assert [r.gate.score for r in results if not r.passed] == []


def test_what_the_views_show_passes_every_gate_on_views(suite, noise) -> None:
    results = held(suite, oracle(noise, all_view_claims(suite)), views=True)
    assert results
    assert [r.gate.score for r in results if not r.passed] == []
    assert not all(r.passed for r in held(suite, noise, views=True))


def test_shuffled_truth_fails_every_gate_on_the_order_against_it(
    suite, claims, noise, ranking
) -> None:
    fed = shuffled(noise, claims, rng=np.random.default_rng(0))
    results = held(suite, fed)
    judged = [r for r in results if r.gate.score in ranking]
    assert judged
    assert [r.gate.score for r in judged if r.passed] == []


def test_values_dealt_out_in_each_view_fail_every_gate_on_how_they_hold(
    suite, claims, noise
) -> None:
    perfect = oracle(noise, claims)
    fed = mixed(perfect, claims, rng=np.random.default_rng(0))
    results = held(suite, fed)
    judged = [r for r in results if r.gate.score.endswith((".cv", ".tau_views", ".tau"))]
    assert any(r.gate.score.endswith(".cv") for r in judged)
    assert [r.gate.score for r in judged if r.passed] == []
    # the truth and the rocks found stay as they are
    assert fed["truth_angularity"].equals(perfect["truth_angularity"])
    assert fed["iou"].equals(perfect["iou"])


def test_shuffling_leaves_the_agreement_of_the_views(suite, claims, noise) -> None:
    values = score_values(suite, shuffled(noise, claims, rng=np.random.default_rng(0)))
    assert values["yard.angularity_2d_deg.kendall_w"] == 1.0


def test_noise_fails_a_gate_on_order_for_every_measure(suite, noise, ranking) -> None:
    # 240 and more pairs a measure within views: τ_b of noise has a standard deviation
    # below 0.15 even with 3 pairs clustered to a rock, so that 0.6 is four of them away.
    gates = [Gate(score=n, at_least=0.6, reason="r") for n in ranking if "yard" in n]
    assert not any(r.passed for r in evaluate(gates, gate_scores(suite, gates, noise)))


def test_every_score_has_a_count_and_an_ordered_interval(suite, noise) -> None:
    scores = score_records(suite, noise)
    assert [score.name for score in scores] == [d.name for d in definitions(suite)]
    rounding = 1e-12  # a weighted mean of equal values
    for score in scores:
        assert score.count > 0, score.name
        if math.isfinite(score.low):
            assert score.low - rounding <= score.value <= score.high + rounding, score.name
    with_interval = {s.name.rpartition(".")[2] for s in scores if math.isfinite(s.low)}
    assert with_interval >= {"tau", "pairs_across", "cv", "cv_normalised", "tau_views"}


def test_intervals_are_the_same_every_time(suite, noise) -> None:
    first, second = score_records(suite, noise), score_records(suite, noise)
    assert repr(first) == repr(second)


def test_rocks_without_a_value_lower_the_share_answered(suite, claims, noise) -> None:
    records = oracle(noise, claims)
    column = "angularity_2d_deg"
    shown = records.index[(records["experiment"] == "yard") & (records["method"] == "paper")]
    eligible = [
        i for i in shown if records.at[i, "eligible"] and records.at[i, "status"] == "matched"
    ]
    records.loc[eligible[::4], column] = np.nan
    values = score_values(suite, records)
    expected = 1 - len(eligible[::4]) / len(eligible)
    assert values[f"yard.{column}.answered"] == pytest.approx(expected, rel=1e-12)
    assert values["yard.ellipse_error_px2.answered"] == 1


def test_what_large_rocks_lack_is_refused(suite, claims, noise) -> None:
    # The rocks are 2 (0.2 * 0.15 * 0.1)^(1/3) = 0.288 m across, 57.7 px of 5 mm.
    records = oracle(noise, claims)
    yard = records["experiment"] == "yard"
    records.loc[yard & (records["view"] == 0), ["axis_ratio", "sphericity_3d"]] = np.nan
    assert score_values(suite, records)["yard.refused"] == pytest.approx(2 / 7 / 4, rel=1e-12)
    far = records.assign(truth_pixel_m=np.where(records["view"] == 0, 0.0097, 0.0096))
    assert score_values(suite, far)["yard.refused"] == 0.0


def test_error_of_the_half_axes(suite, claims, noise) -> None:
    records = oracle(noise, claims)
    assert score_values(suite, records)["yard.axes_error"] == 0.0
    # 0.2 of the rocks whose number is even; of one of those alone, drawn again and again, likewise
    even = records["instance"].isin([0, 2, 4])
    records.loc[even, ["axis_a_m", "axis_b_m", "axis_c_m"]] = [0.22, 0.12, 0.13]
    (axes,) = (one for one in definitions(suite) if one.name == "yard.axes_error")
    found = axes.compute(records)
    assert found.value == pytest.approx(0.1, rel=1e-12)
    assert found.weighted(np.eye(found.rocks)).tolist() == pytest.approx([0.2, 0] * 12, abs=1e-12)


def test_slope_of_measured_on_true_values(suite, noise) -> None:
    form = noise["experiment"] == "form"
    records = noise[form].copy()
    records.loc[records["view"] == 1, "sphericity_3d"] = np.nan
    true = records["truth_maximum_projection_sphericity"]
    kept = records["sphericity_3d"].notna()
    slope, _ = np.polyfit(true[kept], records.loc[kept, "sphericity_3d"], 1)
    found = {one.name: one.compute for one in definitions(suite)}
    assert found["form.sphericity_3d.slope"](records).value == pytest.approx(slope, rel=1e-9)
    # a rock drawn twice weighs twice
    rock = records["scene"] * 6 + records["instance"]
    twice = 1 + (rock % 2).to_numpy()
    weighted, _ = np.polyfit(
        true[kept], records.loc[kept, "sphericity_3d"], 1, w=np.sqrt(twice[kept])
    )
    both = found["form.sphericity_3d.slope"](records).weighted(1.0 + np.arange(24)[None] % 2)
    assert both[0] == pytest.approx(weighted, rel=1e-9)


def test_slopes_of_pure_numbers_alone(suite) -> None:
    names = {one.name for one in definitions(suite)}
    assert {"form.axis_ratio.slope", "form.sphericity_2d.slope"} <= names
    assert "yard.angularity_2d_deg.slope" not in names
    theirs = MeasureSpec(name="mine", function="m:f", expected_trait={"bumps": "angularity"})
    names = {one.name for one in definitions(msgspec.structs.replace(suite, measures=(theirs,)))}
    assert "yard.mine.bumps.tau" in names
    assert "yard.mine.bumps.slope" not in names


def test_mean_absolute_error_beside_the_root_mean_square(suite, claims, noise) -> None:
    records = oracle(noise, claims)
    form = records["experiment"] == "form"
    true = records.loc[form, "truth_maximum_projection_sphericity"]
    off = np.where(records.loc[form, "view"] == 0, 0.4, -0.1)
    records.loc[form, "sphericity_3d"] = true + off
    values = score_values(suite, records)
    assert values["form.sphericity_3d.absolute_error"] == pytest.approx(0.7 / 4, rel=1e-12)
    assert values["form.sphericity_3d.error"] == pytest.approx(np.sqrt(0.19 / 4), rel=1e-12)
    assert values["form.sphericity_3d.bias"] == pytest.approx(0.1 / 4, rel=1e-12)


def test_missed_rocks_lower_recall_and_leave_the_order(suite, claims, noise) -> None:
    fed = oracle(noise, claims)
    lost = (fed["experiment"] == "yard") & (fed["view"] == 0) & (fed["instance"] == 2)
    fed.loc[lost, "status"] = "missed"
    fed.loc[lost, ["iou", "angularity_2d_deg"]] = np.nan
    values = score_values(suite, fed)
    assert values["yard.recall"] == pytest.approx(1 - 1 / 24, rel=1e-12)
    assert values["yard.angularity_2d_deg.tau"] == 1.0


def test_rocks_not_in_plain_view_do_not_count(suite, claims, noise) -> None:
    fed = oracle(noise, claims)
    hidden = (fed["experiment"] == "yard") & (fed["instance"] == 2)
    fed.loc[hidden, "eligible"] = False
    fed.loc[hidden, "angularity_2d_deg"] = -1.0
    fed.loc[hidden, "status"] = "missed"
    values = score_values(suite, fed)
    assert (values["yard.recall"], values["yard.angularity_2d_deg.tau"]) == (1.0, 1.0)


def test_extra_rocks_lower_precision_alone(suite, claims, noise) -> None:
    fed = oracle(noise, claims)
    extra = fed[fed["experiment"] == "yard"].head(6).assign(status="extra", eligible=False)
    rows = len(fed[fed["experiment"] == "yard"])
    values = score_values(suite, pd.concat([fed, extra], ignore_index=True))
    assert values["yard.precision"] == pytest.approx(rows / (rows + 6), rel=1e-12)
    assert (values["yard.recall"], values["yard.angularity_2d_deg.tau"]) == (1.0, 1.0)


def test_gap_shares() -> None:
    assert gap_shares(np.array([1.0, 2.0, 5.0])).tolist() == [0.25, 0.75]
    assert gap_shares(np.array([5.0, 2.0, 1.0])).tolist() == [0.75, 0.25]
    assert np.isnan(gap_shares(np.array([1.0, 2.0, 1.0]))).all()
