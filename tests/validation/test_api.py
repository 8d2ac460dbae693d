"""The front door of validation: one view scored, a suite run, two runs compared."""

import importlib
import subprocess
import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

import rockshape
import validation
from rockshape.method import registered

SUITE = """
name = "drawings"
title = "Drawings"

[[experiment]]
kind = "shapes"
name = "shapes"
title = "Shapes"
seed = 600
drawings = 1
series = ["sphericity"]

[[gate]]
score = "shapes.sphericity.axis_ratio.tau"
at_least = 0.9
reason = "four shapes far apart"

[[gate]]
score = "shapes.robust.sphericity.axis_ratio.tau"
at_least = 0.9
reason = "four shapes far apart"
"""
SCRIPT = """
import validation
done = validation.run("drawings.toml", jobs=1)
print(done.passed, len(done.gates), done.gates["found"].tolist())
"""
RATIOS = (0.4, 0.6, 0.8)


def _ellipses(*, lost: int | None = None) -> np.ndarray:
    """Ellipses of RATIOS on a plane, of a half-axis of 40 px; one may be left out."""
    rows, cols = np.mgrid[0:100, 0:300]
    labels = np.zeros(rows.shape, np.int32)
    for index, ratio in enumerate(RATIOS):
        if index != lost:
            inside = ((cols - 50 - 100 * index) / 40) ** 2 + ((rows - 50) / (40 * ratio)) ** 2 <= 1
            labels[inside] = index + 1
    return labels


@pytest.fixture
def view() -> SimpleNamespace:
    truth = pd.DataFrame({"id": [1, 2, 3], "outline_axis_ratio": RATIOS})
    return SimpleNamespace(labels=_ellipses(), truth=truth)


@pytest.fixture
def suite(tmp_path) -> str:
    path = tmp_path / "drawings.toml"
    path.write_text(SUITE)
    return str(path)


def test_masks_of_the_truth_are_all_found_and_in_order(view) -> None:
    scored = validation.score(rockshape.measure(labels=view.labels), view)
    assert (scored.recall, scored.precision, scored.mean_iou) == (1.0, 1.0, 1.0)
    row = scored.measures.set_index("measure").loc["axis_ratio"]
    assert (row["truth"], row["rocks"], row["tau"]) == ("outline_axis_ratio", 3, 1.0)
    measured = scored.rocks["axis_ratio"].to_numpy()
    error = measured - np.array(RATIOS)
    assert row["bias"] == pytest.approx(error.mean(), rel=1e-12)
    assert row["rms_error"] == pytest.approx(np.sqrt((error**2).mean()), rel=1e-12)
    assert row["rms_error"] < 0.01


def test_missed_and_extra_rocks_are_told(view) -> None:
    labels = _ellipses(lost=1)
    labels[2:12, 2:12] = 9
    scored = validation.score(rockshape.measure(labels=labels), view)
    assert scored.rocks["status"].tolist() == ["matched", "missed", "matched", "extra"]
    assert scored.rocks["rock"].tolist() == [1, pd.NA, 3, 9]
    assert scored.recall == pytest.approx(2 / 3)
    assert scored.precision == pytest.approx(2 / 3)
    assert "2 of 3 rocks found, 1 extra" in repr(scored)
    assert "<table" in scored._repr_html_()


@pytest.mark.parametrize("found", [0, 2])
def test_a_frame_without_rocks_has_reasons_in_place_of_shares(view, found) -> None:
    view.labels, view.truth = np.zeros_like(view.labels), view.truth.iloc[:0]
    labels = np.where(_ellipses() <= found, _ellipses(), 0)
    scored = validation.score(rockshape.measure(labels=labels), view)
    assert np.isnan(scored.recall)
    assert np.isnan(scored.mean_iou)
    assert scored.reasons["recall"] == "no rock in sight"
    assert np.isnan(scored.precision) == (found == 0)
    assert ("precision" in scored.reasons) == (found == 0)
    assert "recall NaN: no rock in sight" in repr(scored)


@pytest.mark.parametrize("shape", [(100, 299), (99, 300)])
def test_another_size_is_refused(view, shape) -> None:
    found = rockshape.measure(labels=_ellipses()[: shape[0], : shape[1]])
    with pytest.raises(validation.InputError, match="expected"):
        validation.score(found, view)


def test_truth_without_ids_is_refused(view) -> None:
    view.truth = view.truth.drop(columns="id")
    with pytest.raises(validation.InputError, match="truth: expected the column id"):
        validation.score(rockshape.measure(labels=view.labels), view)


@pytest.mark.usefixtures("suite")
def test_a_script_without_a_guard_runs_a_suite(tmp_path) -> None:
    (tmp_path / "script.py").write_text(SCRIPT)
    for words in (["script.py"], ["-c", SCRIPT]):
        done = subprocess.run(
            [sys.executable, *words], cwd=tmp_path, capture_output=True, text=True, check=True
        )
        assert done.stdout == "True 2 [1.0, 1.0]\n"


def test_a_run_has_tables_a_report_and_a_comparison(suite, tmp_path) -> None:
    done = validation.run(suite, jobs=1, out=tmp_path / "out", methods=["robust"])
    assert done.gates["score"].tolist() == ["shapes.robust.sphericity.axis_ratio.tau"]
    assert set(done.records["method"]) == {"robust"}
    assert repr(done) == "SuiteResult('drawings': 1 of 1 gates passed)"
    assert (tmp_path / "out" / "index.html").is_file()
    changes = validation.compare(tmp_path / "out", tmp_path / "out")
    assert len(changes) == len(done.scores)
    assert set(changes["verdict"]) == {"same"}


OWN = """
from dataclasses import replace
from rockshape.method import ROBUST

MINE = replace(ROBUST, name="mine", measures=ROBUST.measures[:1])
"""


def test_an_own_method_of_a_module_is_measured_in_workers(suite, tmp_path, monkeypatch) -> None:
    (tmp_path / "own_method.py").write_text(OWN)
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    record = importlib.import_module("own_method").MINE
    with registered(record):
        for number, method in enumerate((record, "own_method:MINE")):
            out = tmp_path / f"out{number}"
            done = validation.run(suite, jobs=1, methods=["robust", method], out=out)
            assert set(done.records["method"]) == {"robust", "mine"}
            by_method = done.records.groupby("method")["axis_ratio"]
            assert by_method.get_group("mine").tolist() == by_method.get_group("robust").tolist()
            assert "shapes.mine.sphericity.axis_ratio.tau" in done.scores["name"].tolist()
        assert set(validation.compare(tmp_path / "out0", tmp_path / "out1")["verdict"]) == {"same"}


def test_a_method_that_no_module_defines_is_refused(suite) -> None:
    nameless = replace(rockshape.ROBUST, name="nameless")
    with pytest.raises(validation.InputError, match="that a module other than the main script"):
        validation.run(suite, methods=[nameless])


def test_a_method_of_the_main_script_is_refused(suite, monkeypatch) -> None:
    mine = replace(rockshape.ROBUST, name="mine")
    monkeypatch.setattr(sys.modules["__main__"], "MINE", mine, raising=False)
    monkeypatch.setitem(sys.modules, "__mp_main__", sys.modules["__main__"])
    with pytest.raises(validation.InputError, match="that a module other than the main script"):
        validation.run(suite, methods=[mine])


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"suite": None}, "suite: expected a name, a TOML file or a Suite, found NoneType"),
        ({"suite": "cii"}, r"suite \(--suite\): expected one of .* did you mean 'ci'"),
        ({"jobs": "two"}, r"jobs \(--jobs\): expected 1 or more, found 'two'"),
        ({"methods": [3]}, "methods: expected names or Method records, found int"),
    ],
)
def test_an_argument_that_cannot_be_used_is_named(suite, arguments, says) -> None:
    with pytest.raises(validation.InputError, match=says):
        validation.run(**{"suite": suite, **arguments})


def test_what_is_no_measurement_or_no_view_is_named(view) -> None:
    found = rockshape.measure(labels=view.labels)
    with pytest.raises(validation.InputError, match="found: expected a Measurement, found Data"):
        validation.score(found.to_frame(), view)
    for other in (None, view.labels, SimpleNamespace(labels=view.labels, truth={"id": [1]})):
        with pytest.raises(validation.InputError, match="view: expected labels, an array, and"):
            validation.score(found, other)


def test_a_method_that_is_passed_as_a_record_is_scored(view) -> None:
    mine = replace(rockshape.ROBUST, name="mine", measures=rockshape.ROBUST.measures[:1])
    scored = validation.score(rockshape.measure(labels=view.labels, method=mine), view)
    assert scored.measures["measure"].tolist() == ["axis_ratio"]
    assert scored.measures["tau"].tolist() == [1.0]


def test_an_unknown_method_and_a_name_alone_are_refused(suite) -> None:
    with pytest.raises(validation.InputError, match="did you mean 'robust'"):
        validation.run(suite, methods=["robsut"])
    with pytest.raises(validation.InputError, match="methods: expected a list"):
        validation.run(suite, methods="robust")


def test_the_import_is_light() -> None:
    code = "import sys, validation; print(sorted({'numpy', 'pandas', 'scipy'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
