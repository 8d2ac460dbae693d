"""Frames of figures 11 and 12: the data, the statements and their scores."""

from importlib.resources import files

import numpy as np
import pytest

from tests.paths import EXAMPLES
from validation.execution.run import Run, assess, prepare, units_of
from validation.execution.work import run_unit
from validation.kinds.frames.page.tables import orders, rock_values
from validation.kinds.frames.shipped import FRAMES, read_frame
from validation.kinds.frames.spec import FramesExperiment
from validation.kinds.frames.statements import STATEMENTS, places
from validation.paper.tables import GARDEN_COLUMNS, garden_table
from validation.suite.suite import load_suite

DATA = files("validation") / "kinds" / "frames" / "data"
SOURCES = {
    "{}.png": "photos/{}_half.png",
    "{}_xyz.npz": "mars/{}_half_xyz.npz",
    "{}_outlines.json": "mars/outlines/{}.json",
}


@pytest.fixture(scope="module")
def run() -> Run:
    suite = prepare(load_suite("pathfinder"))
    return assess(suite, suite.gates, [run_unit(unit) for unit in units_of(suite)])


def experiment_of(run: Run) -> FramesExperiment:
    (experiment,) = run.suite.experiments
    assert isinstance(experiment, FramesExperiment)
    return experiment


@pytest.mark.parametrize("frame", FRAMES)
@pytest.mark.parametrize("name", SOURCES)
def test_the_files_are_the_examples(frame: str, name: str) -> None:
    example = EXAMPLES / SOURCES[name].format(frame)
    assert (DATA / name.format(frame)).read_bytes() == example.read_bytes()


@pytest.mark.parametrize("frame", FRAMES.values())
def test_named_rocks_are_where_the_paper_shows_them(frame) -> None:
    observation, labels = read_frame(frame.name)
    assert labels.shape == observation.image.shape[:2] == (124, 128)
    shown = {  # a pixel (row, column) well inside each, read off the frame
        "Stimpy": (35, 50),
        "Little Flat Top": (66, 98),
        "Flat Top": (83, 15),
        "Bamm-Bamm": (60, 115),
        "Flute Top": (18, 103),
    }
    for rock, number in frame.rocks.items():
        assert labels[shown[rock]] == number


def test_statements_agree_with_table_4_where_it_has_digits_enough() -> None:
    table = garden_table()
    for frame in FRAMES.values():
        for column, printed in GARDEN_COLUMNS.items():
            said = places(frame.figure, column)
            for low in said:
                for high in said:
                    if said[low] < said[high]:
                        one, other = (table[printed][frame.printed[r]] for r in (low, high))
                        assert one <= other, (frame.figure, column, low, high)


def test_places_share_a_place_where_the_text_does_not_part_them() -> None:
    assert places(11, "sphericity_3d") == {"Flat Top": 1, "Little Flat Top": 1, "Stimpy": 2}
    assert places(12, "axis_ratio") == {"Flute Top": 1, "Bamm-Bamm": 2}
    assert places(11, "ellipsoid_error_m2") == {}


def test_every_gate_passes_and_bites(run: Run) -> None:
    assert all(gate.passed for gate in run.gates)
    assert all(check.sound for check in run.checks)


def test_scores_count_the_stated_pairs(run: Run) -> None:
    scores = {score.name: score for score in run.scores}
    # figure 11 parts Stimpy from two rocks, figure 12 two rocks from each other
    assert scores["rocks.angularity_2d_deg.answered"].count == 3
    assert scores["rocks.ellipse_error_px2.answered"].count == 4
    # by hand: of the three whole orders of the ellipse error in px² the larger rock has the larger
    values = {(r.rock, r.title): r.ours[0] for r in rock_values(run, experiment_of(run))}
    error = [values[rock, "ellipse error"] for rock in ("Stimpy", "Flat Top", "Little Flat Top")]
    in_order = (error[0] < error[1]) + (error[0] < error[2]) + (error[1] < error[2])
    in_order += values["Bamm-Bamm", "ellipse error"] < values["Flute Top", "ellipse error"]
    assert scores["rocks.ellipse_error_px2.held"].value == in_order / 4


def test_the_page_has_every_statement_and_every_value(run: Run) -> None:
    experiment = experiment_of(run)
    assert len(orders(run, experiment)) == len(STATEMENTS)
    rows = rock_values(run, experiment)
    assert len(rows) == 5 * 7
    flat_top = next(r for r in rows if (r.rock, r.title) == ("Flat Top", "2-D angularity"))
    assert flat_top.printed == 25.39
    assert np.isfinite(flat_top.ours[0])
