"""Scores of photographs from records in which every count is known."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from rockshape.cli import main
from validation.execution.compare import compare
from validation.execution.recorded import Recorded, check_paired
from validation.kinds.photographs.judge.objects import average_precision
from validation.kinds.photographs.readings import QUANTITIES, TRUE
from validation.scores.scoring import gate_scores, score_values
from validation.selfcheck.oracle import mixed, oracle, shuffled
from validation.suite.gates import evaluate
from validation.suite.suite import Suite, load_suite

SUITES = ("gravel", "photos")


def ap(matched: list[int], true: int, found: int) -> float:
    """Average precision of numbers."""
    draw = (np.array([each], dtype=np.float64) for each in (matched, true, found))
    return float(average_precision(*draw)[0])


def test_average_precision_is_precision_times_recall_over_the_thresholds() -> None:
    # of 3 true and 4 found objects 2 match up to 0.6, 1 up to 0.95
    matched = [2, 2, *(8 * [1])]
    expected = (2 * (2 / 3) * (2 / 4) + 8 * (1 / 3) * (1 / 4)) / 10
    assert ap(matched, 3, 4) == pytest.approx(expected)
    assert ap([0] * 10, 3, 0) == 0
    assert np.isnan(ap([0] * 10, 0, 0))


def test_grain_sizes_are_of_the_pictures_and_spread_over_them() -> None:
    suite = load_suite("photos")
    records = fabricated(suite)
    # found sizes are 1.1 of the true ones in picture 0, and now 1.3 in picture 1
    later = records["scene"] == 1
    for column in QUANTITIES.values():
        records.loc[later, column] *= 1.3 / 1.1
    both = records["status"].isin(["view", "matched"])
    values = score_values(suite, records[both])
    for name in ("d16", "d50", "d84"):
        assert values[f"gravel.image.least_axis_px.{name}_bias"] == pytest.approx(0.2)
        assert values[f"gravel.image.least_axis_px.{name}_error"] == pytest.approx(0.2)
        assert values[f"gravel.image.least_axis_px.{name}_spread"] == pytest.approx(0.1)
    assert values["gravel.image.greatest_axis_px.bias"] == pytest.approx(0.2)
    assert values["gravel.image.greatest_axis_px.spread"] == pytest.approx(0.1)
    size = 14.0 + 8 * np.arange(1, 20)
    off = np.concatenate([0.1 * size, 0.3 * size])
    assert values["gravel.image.roundness.bias"] == pytest.approx(off.mean())
    assert values["gravel.image.roundness.spread"] == pytest.approx(off.std())


def fabricated(suite: Suite) -> pd.DataFrame:
    """Records of a suite in which of 20 rocks in each of two pictures one is missed, one extra."""
    rows = []
    for experiment in suite.experiments:
        for series in experiment.series:
            for scene in range(2):
                place = {"experiment": experiment.name, "kind": "photographs", "series": series}
                place |= {"scene": scene, "seed": 1, "view": 0, "method": ""}
                pixels = {"status": "view", "eligible": False, "common_px": 80.0, "union_px": 90.0}
                rows.append(place | pixels)
                if not experiment.pictures.has_instances:
                    continue
                for i in range(21):
                    state = "missed" if i == 0 else "extra" if i == 20 else "matched"
                    size, found = 14.0 + 8 * i, state != "missed"
                    rows.append(
                        place
                        | {"status": state, "eligible": state != "extra", "width_px": size}
                        | {"instance": np.nan if state == "extra" else i}
                        | {"rock": i if found else np.nan, "split": False, "merged": False}
                        | {"iou": 0.8 if state == "matched" else np.nan}
                        | dict.fromkeys(QUANTITIES.values(), size * 1.1 if found else np.nan)
                        | {TRUE + c: size if i < 20 else np.nan for c in QUANTITIES.values()}
                    )
    return pd.DataFrame(rows)


def verdicts(suite: Suite, records: pd.DataFrame) -> list[bool]:
    return [r.passed for r in evaluate(suite.gates, gate_scores(suite, suite.gates, records))]


@pytest.mark.parametrize("name", SUITES)
def test_the_truth_passes_every_gate_and_whatever_is_lost_or_grown_fails_each(name) -> None:
    suite, rng = load_suite(name), np.random.default_rng(0)
    records = fabricated(suite)
    truth = oracle(records, ())
    assert all(verdicts(suite, truth))
    grown = truth.assign(**{c: truth[c] * 9 for c in QUANTITIES.values()})
    for fed in (shuffled(records, (), rng=rng), mixed(records, (), rng=rng)):
        caught = zip(verdicts(suite, fed), verdicts(suite, grown), suite.gates, strict=True)
        assert [g.score for lost, large, g in caught if lost and large] == []


def test_scores_of_lost_rocks_are_nought() -> None:
    suite = load_suite("photos")
    values = score_values(suite, shuffled(fabricated(suite), (), rng=np.random.default_rng(0)))
    for name in ("f1", "recall", "ap", "pixel_iou", "roundness.coverage"):
        assert values[f"gravel.image.{name}"] == 0


def test_a_finder_that_finds_fewer_rocks_is_worse_on_the_same_pictures() -> None:
    suite = load_suite("photos")
    records = fabricated(suite)
    lost = (records["series"] == "image") & records["instance"].between(5, 14)
    fewer = records.assign(status=records["status"].mask(lost, "missed"))
    old, new = (Recorded(Path("run"), suite, each, {}) for each in (records, fewer))
    check_paired(old, new)
    found = {change.name: change.verdict for change in compare(old, new)}
    assert found["gravel.image.recall"] == found["gravel.image.f1"] == "worse"
    assert found["gravel.top-hat.f1"] == "same"


def test_a_suite_of_files_is_run_resumed_shown_and_compared(folder, capsys) -> None:
    words = ["validate", "run", "--suite", "mine.toml", "--out", "run"]
    assert main(words) == 0
    page = (folder / "run" / "index.html").read_text(encoding="utf-8")
    for told in (
        "<th>top-hat</th>",
        "F1 by size",
        "Grain sizes from found outlines",
        "otsu, discs",
    ):
        assert told in page
    before = (folder / "run" / "scores.json").read_bytes()
    capsys.readouterr()
    assert main([*words, "--resume"]) == 0
    assert (folder / "run" / "scores.json").read_bytes() == before
    assert main(["validate", "compare", "run", "run"]) == 0
