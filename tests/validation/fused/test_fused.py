"""Fused experiments: their records and scores, and gates that a broken fusion fails."""

from collections.abc import Callable

import numpy as np
import pytest

from rockshape.fusion.alignment import Alignment
from rockshape.fusion.matching import match_rocks
from validation.errors import InputError
from validation.execution.run import Run, assess, prepare, units_of
from validation.execution.work import run_unit
from validation.kinds.fused.page.tables import form_rows
from validation.kinds.fused.spec import ALONE, EXACT, FUSED, GIVEN, REFINED, FusedExperiment
from validation.suite.suite import load_suite

SUITE = """
name = "small"
title = "Three rocks from four sides"

[[experiment]]
kind = "fused"
name = "rocks"
title = "Three rocks from four sides"
seed = 7
scenes = 1

[experiment.scene]
renderer = "embree"

[experiment.scene.rocks]
count = 3
family = "realistic"
series = "random"
spacing = 1.9

[experiment.scene.ground]
resting = "stable"

[experiment.scene.camera]
preset = "imp"

[experiment.scene.calibration]
turn_deg = 0.5
shift_m = 0.01

[[gate]]
score = "rocks.robust.refined.matched"
at_least = 0.9
reason = "As in the suite fused."

[[gate]]
score = "rocks.robust.refined.sphericity_3d.error"
at_most = 0.05
reason = "As in the suite fused."

[[gate]]
score = "rocks.robust.refined.sphericity_3d.gain"
at_least = 0.0
reason = "As in the suite fused."
"""


@pytest.fixture(scope="module")
def fused(tmp_path_factory: pytest.TempPathFactory) -> Callable[[], Run]:
    path = tmp_path_factory.mktemp("fused") / "small.toml"
    path.write_text(SUITE, encoding="utf-8")
    suite = prepare(load_suite(str(path)))
    return lambda: assess(suite, suite.gates, [run_unit(unit) for unit in units_of(suite)])


@pytest.fixture(scope="module")
def run(fused: Callable[[], Run]) -> Run:
    return fused()


def failed(run: Run) -> set[str]:
    """Statistics whose gates failed."""
    return {one.gate.score.rpartition(".")[2] for one in run.gates if not one.passed}


def test_every_gate_passes_and_the_checks_are_sound(run: Run) -> None:
    assert failed(run) == set()
    assert all(check.sound for check in run.checks)


def test_records_have_every_view_and_every_way(run: Run) -> None:
    records = run.records
    assert set(records["series"]) == {ALONE, *FUSED}
    alone = records[records["series"] == ALONE]
    assert alone.groupby("instance")["view"].nunique().tolist() == [4, 4, 4]
    for way in FUSED:
        own = records[records["series"] == way]
        assert own["instance"].tolist() == [0, 1, 2]
        assert own["truth_maximum_projection_sphericity"].notna().all()


def test_scores_are_differences_from_the_truth(run: Run) -> None:
    scores = {score.name: score.value for score in run.scores}
    errors = {}
    for way in (ALONE, *FUSED):
        own = run.records[run.records["series"] == way]
        off = own["sphericity_3d"] - own["truth_maximum_projection_sphericity"]
        errors[way] = float(np.sqrt(np.mean(off[own["eligible"]] ** 2)))
        found = scores[f"rocks.robust.{way}.sphericity_3d.error"]
        assert found == pytest.approx(errors[way], nan_ok=True)
    gain = scores["rocks.robust.refined.sphericity_3d.gain"]
    assert gain == pytest.approx(errors[ALONE] - errors[REFINED])
    given, refined = (scores[f"rocks.robust.{way}.matched"] for way in (GIVEN, REFINED))
    assert given < refined  # the poses are off by half a rock
    assert errors[REFINED] == pytest.approx(errors[EXACT], abs=0.01)


def test_the_page_has_a_row_for_each_way(run: Run) -> None:
    (experiment,) = run.suite.experiments
    assert isinstance(experiment, FusedExperiment)
    rows = form_rows(run, experiment)
    assert [row.words.split(",")[0] for row in rows] == ["each view alone", *["views fused"] * 3]
    assert rows[0].matched is None


def test_poses_left_as_they_are_fail(fused, monkeypatch) -> None:
    def kept(views):
        poses = tuple(view.pose for view in views)
        return Alignment(poses, (0.0,) * len(poses), (0.0,) * len(poses))

    monkeypatch.setattr("rockshape.fusion.fusion.align", kept)
    assert "error" in failed(fused())


def test_rocks_that_are_not_matched_fail(fused, monkeypatch) -> None:
    def apart(views):
        return [[sight] for sights in match_rocks(views) for sight in sights]

    monkeypatch.setattr("rockshape.fusion.fusion.match_rocks", apart)
    assert failed(fused()) == {"matched", "error", "gain"}


def test_a_form_that_is_no_rocks_own_fails(fused, monkeypatch) -> None:
    def cube(seen):  # noqa: ARG001
        return np.full(3, 0.1)

    monkeypatch.setattr("rockshape.fusion.fused_rock.fused_half_axes_m", cube)
    assert failed(fused()) == {"error", "gain"}


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("[experiment.scene.calibration]\nturn_deg = 0.5\nshift_m = 0.01", "", "calibration"),
        ("spacing = 1.9", "spacing = 1.9\n[experiment.scene.views]\ncount = 1", "views.count"),
    ],
)
def test_views_that_make_no_fusion_are_refused(tmp_path, old: str, new: str, told: str) -> None:
    path = tmp_path / "small.toml"
    path.write_text(SUITE.replace(old, new), encoding="utf-8")
    with pytest.raises(InputError, match=f"{told}: expected"):
        load_suite(str(path))
