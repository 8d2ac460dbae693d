"""Pebbles at several resolutions: masks that shrink, what is scored, and gates that bite."""

import re

import msgspec
import numpy as np
import pytest
from scipy.stats import kendalltau

from validation.errors import InputError
from validation.execution.run import Run, assess, prepare, units_of
from validation.execution.work import run_unit
from validation.kinds.pebbles.page import section
from validation.kinds.pebbles.sheet import MARGIN_PX, pebble_masks, sheet, shrunk
from validation.kinds.pebbles.spec import PebblesExperiment
from validation.peers import MeasureSpec
from validation.report.section import Room
from validation.suite.suite import Suite, load_suite

HELD_OUT = "pebbles-held-out"


def suite_of(*names: str) -> Suite:
    """The suite `outlines` with some of its experiments and their gates."""
    suite = load_suite("outlines")
    experiments = tuple(each for each in suite.experiments if each.name in names)
    gates = tuple(gate for gate in suite.gates if gate.score.split(".")[0] in names)
    return prepare(msgspec.structs.replace(suite, experiments=experiments, gates=gates))


@pytest.fixture(scope="module")
def run() -> Run:
    suite = suite_of("pebbles", HELD_OUT)
    return assess(suite, suite.gates, [run_unit(unit) for unit in units_of(suite)])


def test_a_mask_shrinks_to_the_pixels_that_are_half_in_it() -> None:
    mask = np.zeros((7, 10), dtype=bool)
    mask[1:5, 3:9] = True  # two thirds of each three rows
    assert shrunk(mask, 3).tolist() == [[False, True, True], [False, True, True]]
    assert shrunk(mask[:, 1:], 3).tolist() == [[False, True, False], [False, True, False]]
    assert np.array_equal(shrunk(mask, 1), mask)


def test_a_sheet_has_each_mask_by_itself() -> None:
    tall, square = np.ones((5, 2), dtype=bool), np.ones((3, 3), dtype=bool)
    labels = sheet([tall, np.zeros((4, 4), dtype=bool), np.pad(square, 7)])
    assert np.bincount(labels.ravel())[1:].tolist() == [10, 0, 9]
    rows = np.flatnonzero(labels.any(axis=1))
    assert rows[0] == MARGIN_PX
    assert np.diff(rows).max() > 2 * MARGIN_PX  # free ground between any two
    assert labels[:, :MARGIN_PX].sum() == labels[:, -MARGIN_PX:].sum() == 0
    assert sheet([]).shape == (1, 1)


def test_a_pebble_that_the_frame_cuts_or_that_is_small_does_not_count() -> None:
    labels = np.zeros((60, 60), dtype=np.int32)
    labels[0:30, 0:30], labels[35:40, 35:40], labels[5:30, 33:58] = 1, 2, 3
    (only,) = pebble_masks(labels, 12.0)
    assert np.array_equal(only, labels == 3)


def test_every_gate_passes_and_bites(run: Run) -> None:
    assert [gate.gate.score for gate in run.gates if not gate.passed] == []
    assert all(check.sound for check in run.checks)


def test_records_have_the_value_at_full_resolution_beside_each(run: Run) -> None:
    records = run.records
    assert set(records["series"]) == {"half", "third"}
    pebbles = records[records["experiment"] == HELD_OUT]
    assert len(pebbles) == 2 * 2 * 9  # resolutions, methods, pebbles
    assert np.isfinite(pebbles["truth_axis_ratio"]).all()
    by_rock = pebbles.groupby(["method", "instance"])["truth_axis_ratio"].nunique()
    assert (by_rock == 1).all()  # one full resolution for both coarser ones


def test_scores_are_those_of_the_records(run: Run) -> None:
    scores = {score.name: score for score in run.scores}
    records = run.records
    own = records[
        (records["experiment"] == HELD_OUT)
        & (records["method"] == "robust")
        & (records["series"] == "third")
    ]
    here, full = (own[name].to_numpy(float) for name in ("roundness", "truth_roundness"))
    named = f"{HELD_OUT}.robust.third.roundness"
    assert scores[f"{named}.tau"].value == pytest.approx(kendalltau(here, full).statistic)
    assert scores[f"{named}.change"].value == pytest.approx(np.median(here) - np.median(full))
    assert scores[f"{named}.answered"].value == 1.0
    assert scores[f"{named}.answered"].count == 9


def test_the_published_angularity_does_not_keep_its_level(run: Run) -> None:
    scores = {score.name: score.value for score in run.scores}
    assert scores["pebbles.third.angularity_2d_deg.change"] > 5  # degrees: its triangles are pixels


def test_a_measure_from_elsewhere_is_held_to_its_own_values() -> None:
    peer = MeasureSpec(
        name="peer",
        function="validation.peers.adapters.scikit_image:measure",
        expected_trait={"solidity": "roundness"},
    )
    suite = msgspec.structs.replace(suite_of(HELD_OUT), measures=(peer,))
    run = assess(suite, (), [run_unit(unit) for unit in units_of(suite)])
    scores = {score.name: score.value for score in run.scores}
    assert scores[f"{HELD_OUT}.peer.third.solidity.answered"] == 1.0
    assert scores[f"{HELD_OUT}.peer.third.solidity.tau"] > 0.5


def test_masks_that_do_not_tell_rocks_apart_are_refused() -> None:
    suite = suite_of(HELD_OUT)
    (experiment,) = suite.experiments
    assert isinstance(experiment, PebblesExperiment)
    curiosity = msgspec.structs.replace(experiment.pictures, names=("curiosity-332",))
    with pytest.raises(InputError, match="pictures: expected masks that tell rocks apart"):
        msgspec.structs.replace(experiment, pictures=curiosity).check()


def test_the_page_has_every_measure_with_its_unit_and_whose_pictures_they_are(run: Run) -> None:
    experiment = next(each for each in run.suite.experiments if each.name == HELD_OUT)
    assert isinstance(experiment, PebblesExperiment)
    shown = str(section(run, experiment, Room({}, 100, 1.0)))
    assert shown.count("<tr>") == 1 + 2 * 9  # two resolutions of four measures and of five
    assert re.search(r"2-D angularity</td><td>third</td><td class=\"n\">[0-9.]+ °", shown)
    assert "David Mair" in shown
