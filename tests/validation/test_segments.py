"""Segmentations judged on drawn labels, where what is right is known."""

from dataclasses import replace
from pathlib import Path

import msgspec
import numpy as np
import pandas as pd
import pytest

from rockshape.method import PAPER, registered
from rockshape.observation import Observation
from validation.errors import InputError
from validation.execution.compare import compare
from validation.execution.recorded import Recorded, check_paired
from validation.execution.run import assess
from validation.execution.store import UnitStore, pack, unit_key
from validation.execution.units import Unit, UnitResult
from validation.execution.work import run_unit
from validation.kinds.segmentation.baselines import fixed_height, plain_watershed
from validation.kinds.segmentation.spec import SegmentationExperiment
from validation.peers.finders.otsu import otsu
from validation.records.object_matching import Rule, judge
from validation.report.page import page_html
from validation.report.summary import summary_markdown
from validation.scores.scoring import gate_scores, score_values
from validation.selfcheck.oracle import mixed, oracle, shuffled
from validation.suite.decode import decode_experiment
from validation.suite.gates import Gate, evaluate
from validation.suite.suite import load_suite

RULE = Rule(min_iou=0.5, min_width_px=12)


def squares(*boxes: tuple[int, int, int, int]) -> np.ndarray:
    """Labels of boxes (top, bottom, left, right), numbered as given."""
    labels = np.zeros((100, 160), dtype=np.int32)
    for number, (top, bottom, left, right) in enumerate(boxes, start=1):
        labels[top:bottom, left:right] = number
    return labels


TWO = squares((20, 60, 20, 60), (20, 60, 60, 100))
ALL = np.array([False, True, True])


def status(rows: pd.DataFrame) -> list[str]:
    return sorted(rows["status"])


def test_the_truth_is_perfect() -> None:
    rows = judge(TWO, ALL, 3 * TWO, {}, RULE)
    assert status(rows) == ["matched", "matched"]
    assert (rows["iou"] == 1).all()
    assert (rows["boundary_px"] == 0).all()
    assert not rows["split"].any()
    assert not rows["merged"].any()


def test_nothing_found_is_all_missed() -> None:
    assert status(judge(TWO, ALL, np.zeros_like(TWO), {}, RULE)) == ["missed", "missed"]


def test_two_rocks_as_one_are_merged_and_missed() -> None:
    rows = judge(TWO, ALL, (TWO > 0).astype(np.int32), {}, RULE)
    # the one found has an overlap of exactly one half with each, which is not above it
    assert status(rows) == ["extra", "missed", "missed"]
    assert rows["merged"].fillna(False).sum() == 2


def test_one_rock_as_two_is_split() -> None:
    halves = squares((20, 40, 20, 60), (40, 60, 20, 60), (20, 60, 60, 100))
    rows = judge(TWO, ALL, halves, {}, RULE)
    assert rows.set_index("instance").loc[0, "split"]
    assert not rows.set_index("instance").loc[1, "split"]


def test_what_does_not_count_is_neither_right_nor_wrong() -> None:
    only_first = np.array([False, True, False])
    found = squares((20, 60, 20, 60), (20, 60, 60, 75), (80, 90, 100, 108), (0, 30, 130, 160))
    # a piece of the rock that does not count, one too narrow, one on the border of the frame
    assert status(judge(TWO, only_first, found, {}, RULE)) == ["matched"]


def test_a_rock_where_there_is_none_is_extra() -> None:
    found = squares((20, 60, 20, 60), (20, 60, 60, 100), (70, 90, 100, 130))
    assert status(judge(TWO, ALL, found, {}, RULE)) == ["extra", "matched", "matched"]


def test_outlines_off_by_two_pixels_are_two_pixels_off() -> None:
    grown = squares((18, 62, 18, 62))
    one = squares((20, 60, 20, 60))
    rows = judge(one, ALL[:2], grown, {}, RULE)
    assert rows["boundary_px"].iloc[0] == pytest.approx(2.0)
    ring = np.array([[x, y] for x in np.arange(19.5, 60, 0.5) for y in (19.5, 59.5)])
    sides = np.vstack([ring, ring[:, ::-1]])
    exact = judge(one, ALL[:2], grown, {1: sides}, RULE)
    assert exact["boundary_px"].iloc[0] == pytest.approx(0.0, abs=1e-9)


def test_labels_of_another_shape_are_refused() -> None:
    with pytest.raises(InputError, match="labels: expected"):
        judge(TWO, ALL, TWO[:50], {}, RULE)


def test_baselines_find_a_box_on_a_plane() -> None:
    y, x = np.mgrid[:100, :160]
    points = np.stack([x / 100, np.full(x.shape, 1.0), 1 + y / 100], axis=-1)
    box = squares((40, 60, 60, 90)) > 0
    points[box, 1] -= 0.2
    image = np.where(box, 0.2, 0.7).astype(np.float32)
    observation = Observation(image=image, points_m=points)
    for way in (fixed_height, otsu, plain_watershed):
        assert ((way(observation) > 0) == box).mean() > 0.99
    blind = Observation(image=np.full((100, 160), 0.5, dtype=np.float32))
    for way in (fixed_height, otsu, plain_watershed):
        assert way(blind).max() == 0


def fabricated() -> pd.DataFrame:
    """Records of the suite's experiments in which every rock is found but one, with one extra."""
    suite = load_suite("segmentation")
    rows = []
    for experiment in suite.experiments:
        for series in experiment.series:
            place = {"experiment": experiment.name, "kind": "segmentation", "series": series}
            place["method"] = ""
            for scene in range(2):
                for instance in range(20):
                    state = "missed" if instance == 0 else "extra" if instance == 1 else "matched"
                    rows.append(
                        place
                        | {"scene": scene, "seed": scene, "view": 0, "status": state}
                        | {"instance": instance, "eligible": state != "extra"}
                        | {"iou": 0.8 if state == "matched" else np.nan, "width_px": 30}
                        | {"boundary_px": 0.7, "split": instance == 2, "merged": False}
                        | {"depth_m": 5.0, "ground_sigmas": 0.1, "cover": 0.1}
                    )
    return pd.DataFrame(rows)


def test_scores_are_the_counts() -> None:
    values = score_values(load_suite("segmentation"), fabricated())
    assert values["sparse.robust-exact.f1"] == pytest.approx(2 * 36 / (2 * 36 + 2 + 2))
    assert values["sparse.robust-exact.precision"] == pytest.approx(36 / 38)
    assert values["sparse.robust-exact.recall"] == pytest.approx(36 / 38)
    assert values["sparse.robust-exact.mean_iou"] == pytest.approx(0.8)
    assert values["sparse.robust-exact.boundary_px"] == pytest.approx(0.7)
    assert values["sparse.robust-exact.splits"] == 2
    assert values["sparse.robust-exact.ground_error"] == pytest.approx(0.1)
    assert values["sparse.robust-exact.f1_depth_4_6"] == values["sparse.robust-exact.f1"]
    assert np.isnan(values["sparse.robust-exact.f1_depth_6_8"])


def test_the_truth_passes_every_gate_and_other_rocks_none_on_what_was_found() -> None:
    suite, rng = load_suite("segmentation"), np.random.default_rng(0)
    records = fabricated()
    passed = evaluate(suite.gates, gate_scores(suite, suite.gates, oracle(records, ())))
    assert [result.gate.score for result in passed if not result.passed] == []
    for fed in (shuffled(records, (), rng=rng), mixed(records, (), rng=rng)):
        judged = evaluate(suite.gates, gate_scores(suite, suite.gates, fed))
        assert [r.gate.score for r in judged if r.passed and r.gate.score.endswith("f1")] == []


def test_range_that_a_scene_does_not_have_is_refused() -> None:
    experiment = load_suite("segmentation").experiments[0]
    table = msgspec.to_builtins(experiment) | {"series": ["robust-sgm"]}
    with pytest.raises(msgspec.ValidationError, match=r"needs scene\.noise\.kind"):
        msgspec.convert(table, type(experiment))


def with_series(series: str) -> SegmentationExperiment:
    """The suite's first experiment in one way, decoded as a suite's table is."""
    experiment = load_suite("segmentation").experiments[0]
    table = {**msgspec.to_builtins(experiment), "kind": "segmentation", "series": [series]}
    return decode_experiment(table, where="my.toml", path="experiment[0]")


@pytest.mark.parametrize(
    ("series", "said"),
    [
        ("nobody-exact", "expected one of paper, robust, .*, found 'nobody'"),
        ("wathershed-exact", "did you mean 'watershed'"),
        ("otsu-exact", "expected other range for otsu, found 'exact'"),
        ("height-none", "expected other range for height, found 'none'"),
        ("robust", "expected a way and its range"),
    ],
)
def test_a_way_that_is_not_there_or_has_not_its_range_is_refused(series, said) -> None:
    with pytest.raises(InputError, match=said):
        with_series(series)


def test_a_registered_method_is_a_way() -> None:
    with registered(replace(PAPER, name="mine")):
        assert with_series("mine-exact").series == ("mine-exact",)
    with pytest.raises(InputError, match="'mine'"):
        with_series("mine-exact")


def tiny() -> SegmentationExperiment:
    """One view of two ways on the first scene."""
    experiment = load_suite("segmentation").experiments[0]
    scene = msgspec.structs.replace(
        experiment.scene,
        renderer="embree",
        views=msgspec.structs.replace(experiment.scene.views, count=1),
    )
    return msgspec.structs.replace(
        experiment, scene=scene, series=("height-exact", "otsu-none"), scenes=2
    )


def test_a_unit_is_read_back_as_it_was_stored(tmp_path) -> None:
    unit = Unit(tiny(), "", 0)
    made = run_unit(unit)
    assert set(made.records["series"]) == {"height-exact", "otsu-none"}
    assert set(made.records["method"]) == {""}
    store = UnitStore(tmp_path / "units", keep=False)
    store.put(unit_key(unit), pack(made))
    found = store.get(unit_key(unit))
    pd.testing.assert_frame_equal(found.records, made.records)
    assert [p.jpeg for p in found.pictures] == [p.jpeg for p in made.pictures]
    assert {p.place.series for p in found.pictures} == {"height-exact", "otsu-none"}


def test_the_key_is_of_what_the_records_depend_on() -> None:
    experiment = tiny()
    key = unit_key(Unit(experiment, "", 0))
    replace = msgspec.structs.replace
    for same in (replace(experiment, title="T"), replace(experiment, scenes=9)):
        assert unit_key(Unit(same, "", 0)) == key
    for other in (replace(experiment, min_width_px=13), replace(experiment, series=("otsu-none",))):
        assert unit_key(Unit(other, "", 0)) != key
    assert unit_key(Unit(experiment, "", 1)) != key


def two_ways(records: pd.DataFrame) -> Recorded:
    """Records of two ways on one experiment, as a run that was read."""
    suite = load_suite("segmentation")
    ways = ("paper-exact", "robust-exact")
    sparse = msgspec.structs.replace(suite.experiments[0], series=ways)
    own = (records["experiment"] == "sparse") & records["series"].isin(ways)
    small = msgspec.structs.replace(suite, experiments=(sparse,))
    return Recorded(Path("run"), small, records[own], {})


def test_a_segmentation_that_finds_fewer_rocks_is_worse_on_the_same_rocks() -> None:
    records = fabricated()
    records.loc[records["status"] == "extra", "instance"] = np.nan
    lost = (records["series"] == "robust-exact") & records["instance"].between(10, 14)
    fewer = records.copy()
    fewer.loc[lost, "status"] = "missed"
    fewer.loc[lost, "iou"] = np.nan
    old, new = two_ways(records), two_ways(fewer)
    check_paired(old, new)
    verdicts = {change.name: change.verdict for change in compare(old, new)}
    assert verdicts["sparse.robust-exact.recall"] == "worse"
    assert verdicts["sparse.robust-exact.f1"] == "worse"
    assert verdicts["sparse.paper-exact.f1"] == "same"
    with pytest.raises(InputError, match="expected the"):
        check_paired(old, two_ways(records[records["instance"] != 3]))


def test_a_view_without_any_rock_is_no_rock() -> None:
    records = fabricated()
    view = records.iloc[[0]].assign(status="view", instance=np.nan, iou=np.nan, eligible=False)
    old, new = two_ways(records), two_ways(pd.concat([records, view], ignore_index=True))
    check_paired(old, new)
    fed = oracle(new.records, ())
    assert (fed["status"] == "view").sum() == 1
    assert score_values(new.suite, fed) == pytest.approx(
        score_values(old.suite, oracle(old.records, ())), nan_ok=True
    )


def test_the_page_has_a_row_for_each_way_and_no_leaderboard() -> None:
    recorded = two_ways(fabricated())
    gate = Gate(score="sparse.robust-exact.f1", at_least=0.9, reason="r")
    result = UnitResult(recorded.records, (), "embree")
    run = assess(recorded.suite, (gate,), [result])
    assert [check.sound for check in run.checks] == [True, True, True]
    page = page_html(run, command="c", seconds=1.0)
    assert "<th>paper-exact</th>" in page
    assert "<th>robust-exact</th>" in page
    assert "Leaderboard" not in page + summary_markdown(run)
    assert "bootstrap intervals over scenes" in page
