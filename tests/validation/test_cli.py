"""The command from its arguments to its exit status, on a suite of seconds."""

import json

import pandas as pd
import pytest

from rockshape.cli import main
from rockshape.method import methods
from synth.render import backends
from validation.execution.recorded import FORMAT
from validation.execution.units import describe, units_of
from validation.suite.suite import load_suite

SUITE = """
name = "tiny"
title = "One small scene and one drawing"

[[experiment]]
kind = "multiview"
name = "yard"
title = "Yard"
seed = 10500
scenes = 1
varied = ["angularity", "form"]

[experiment.scene]
renderer = "embree"

[experiment.scene.rocks]
count = 2
series = "random"
family = "rounded-box"

[experiment.scene.camera]
preset = "imp"
supersample = 1

[experiment.scene.views]
count = 2

[[experiment]]
kind = "shapes"
name = "shapes"
title = "Shapes"
seed = 10600
drawings = 1

[[gate]]
score = "shapes.sphericity.axis_ratio.tau"
at_least = 0.99
reason = "four shapes far apart"
"""
BAD_GATE = (
    '[[gate]]\nscore = "shapes.sphericity.axis_ratio.tau"\nat_least = 1.5\nreason = "never"\n'
)


@pytest.fixture
def suite_path(tmp_path):
    path = tmp_path / "tiny.toml"
    path.write_text(SUITE, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """The suite run twice: with one process, and with two and a gate that cannot be passed."""
    folder = tmp_path_factory.mktemp("runs")
    (folder / "tiny.toml").write_text(SUITE, encoding="utf-8")
    (folder / "never.toml").write_text(BAD_GATE, encoding="utf-8")
    command = ["validate", "run", "--suite", str(folder / "tiny.toml"), "--out"]
    passed = main([*command, str(folder / "one"), "--jobs", "1"])
    gates = ["--gates", str(folder / "never.toml")]
    failed = main([*command, str(folder / "two"), "--jobs", "2", *gates])
    return folder, passed, failed


def test_exit_status_tells_the_verdict(runs) -> None:
    _, passed, failed = runs
    assert (passed, failed) == (0, 1)


def test_records_do_not_depend_on_the_number_of_processes(runs) -> None:
    folder, _, _ = runs
    one, two = (pd.read_parquet(folder / name / "results.parquet") for name in ("one", "two"))
    pd.testing.assert_frame_equal(one, two, check_exact=True)


def test_the_records_hold_truth_and_measures_of_every_rock(runs) -> None:
    folder, _, _ = runs
    records = pd.read_parquet(folder / "one" / "results.parquet")
    rocks = records[(records["kind"] == "multiview") & (records["status"] != "extra")]
    assert len(rocks) == 2 * 2 * len(methods())  # rocks, views
    assert rocks["truth_maximum_projection_sphericity"].between(0, 1).all()
    found = rocks[rocks["status"] == "matched"]
    assert len(found) == len(rocks)
    assert (found["iou"] > 0.8).all()  # one pixel round a rock of 60 px on clean range
    paper, robust = (found[found["method"] == name] for name in ("paper", "robust"))
    assert paper["ellipsoid_error_m2"].notna().all()
    assert robust["ellipsoid_error"].notna().all()
    shapes = records[records["kind"] == "shapes"]
    assert len(shapes) == 2 * 4 * len(methods())  # series, shapes
    assert (shapes["iou"] == 1.0).all()
    assert shapes["reason"].eq("no range").all()


def test_scores_and_page_name_the_renderer(runs) -> None:
    folder, _, _ = runs
    scores = json.loads((folder / "one" / "scores.json").read_text(encoding="utf-8"))
    assert (scores["passed"], scores["backend"]) == (True, "embree")
    page = (folder / "two" / "index.html").read_text(encoding="utf-8")
    assert "✗ 1 of 1 gates failed" in page
    records = pd.read_parquet(folder / "two" / "results.parquet")
    portraits = int((records["method"] == "paper").sum())  # all are matched: a row, a rock view
    assert page.count("data:image/jpeg;base64,") == 2 + 2 + portraits


def _refused(arguments: list[str], capsys) -> str:
    status = main(["validate", "run", *arguments])
    error = capsys.readouterr().err
    assert status == 2
    assert error.count("\n") == 1
    return error


def test_bad_arguments_are_one_line_and_status_2(tmp_path, suite_path, capsys) -> None:
    out = ["--out", str(tmp_path / "out")]
    assert "--suite" in _refused(["--suite", "nope", *out], capsys)
    assert "none.toml" in _refused(["--suite", str(tmp_path / "none.toml"), *out], capsys)
    suite = ["--suite", str(suite_path)]
    assert "--jobs" in _refused([*suite, *out, "--jobs", "0"], capsys)
    assert "--out" in _refused([*suite, "--out", str(tmp_path)], capsys)
    assert "none.toml" in _refused([*suite, *out, "--gates", str(tmp_path / "none.toml")], capsys)
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(BAD_GATE.replace("tau", "tao"), encoding="utf-8")
    assert "tao" in _refused([*suite, *out, "--gates", str(wrong)], capsys)
    assert not (tmp_path / "out").exists()


def test_odd_folders_are_refused_before_any_work(tmp_path, suite_path, capsys, monkeypatch) -> None:
    monkeypatch.setattr("validation.commands.run.run_suite", None)
    suite = ["--suite", str(suite_path), "--out"]
    nowhere, file = tmp_path / "nowhere", tmp_path / "file"
    nowhere.symlink_to(tmp_path / "absent")
    file.write_text("mine", encoding="utf-8")
    earlier = tmp_path / "earlier"
    (earlier / "index.html").mkdir(parents=True)
    (earlier / "scores.json").write_text(json.dumps({"format": FORMAT}), encoding="utf-8")
    assert "link to nowhere" in _refused([*suite, str(nowhere)], capsys)
    assert "the file" in _refused([*suite, str(file)], capsys)
    assert "place for a folder" in _refused([*suite, str(file / "within")], capsys)
    assert "index.html" in _refused([*suite, str(earlier)], capsys)
    assert not (tmp_path / "absent").exists()


def test_a_missing_renderer_is_one_line_and_status_3(
    tmp_path, suite_path, capsys, monkeypatch
) -> None:
    monkeypatch.setattr(backends, "has_backend", lambda _: False)
    out = tmp_path / "out"
    assert main(["validate", "run", "--suite", str(suite_path), "--out", str(out)]) == 3
    error = capsys.readouterr().err
    assert error.splitlines()[-1].startswith("rockshape: ")
    assert "embreex" in error
    assert "Traceback" not in error
    assert not out.exists()


def test_units_are_in_the_order_of_the_suite(suite_path) -> None:
    units = units_of(load_suite(str(suite_path)))
    assert [describe(unit) for unit in units] == [
        "yard 10500",
        "shapes roundness 10600",
        "shapes sphericity 10600",
    ]
