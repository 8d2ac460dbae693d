"""A run's folder: its five files agree, need nothing else, and replace only an earlier run."""

import json
import re
from html.parser import HTMLParser

import cv2
import numpy as np
import pandas as pd
import pytest
from junitparser import JUnitXml

from validation.claims import Claim
from validation.errors import InputError
from validation.oracle import oracle
from validation.pictures import Picture, compress, crop_box
from validation.records import Place
from validation.report import check_target, write_run
from validation.report.charts import Points, scatter
from validation.report.ranks import rank_table
from validation.report.words import interval, number
from validation.run import assess
from validation.units import UnitResult

FILES = {"index.html", "scores.json", "results.parquet", "junit.xml", "summary.md"}


def picture() -> Picture:
    labels = np.zeros((60, 80), np.int32)
    labels[20:40, 30:60] = 1
    overlay = np.full((120, 160, 3), 90, np.uint8)
    return Picture(Place("yard", "yard", "", 0, 10000, 0, "paper"), *compress(overlay, labels))


@pytest.fixture(scope="module", params=["noise", "oracle"])
def run(request, suite, claims, noise):
    records = oracle(noise, claims) if request.param == "oracle" else noise
    return assess(suite, suite.gates, [UnitResult(records, (picture(),), "embree")])


class _Links(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.links: list[str] = []
        self.open: list[str] = []

    def handle_starttag(self, tag, attrs) -> None:
        self.links += [value for name, value in attrs if name in {"src", "href"}]
        if tag not in {"meta", "br", "img", "wbr"}:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs) -> None:
        pass

    def handle_endtag(self, tag) -> None:
        assert self.open.pop() == tag


def write(run, out) -> None:
    write_run(run, out, command="rockshape validate run --suite ci", seconds=1.0)


def test_the_five_files_tell_the_same(run, tmp_path) -> None:
    out = tmp_path / "deep" / "run"
    write(run, out)
    assert {file.name for file in out.iterdir()} == FILES
    assert [file.name for file in out.parent.iterdir()] == ["run"]
    scores = json.loads((out / "scores.json").read_text(encoding="utf-8"))
    assert scores["passed"] is run.passed
    values = {score["name"]: score["value"] for score in scores["scores"]}
    assert values == {score.name: score.value for score in run.scores}
    failed = [gate["score"] for gate in scores["gates"] if not gate["passed"]]
    junit = JUnitXml.fromfile(str(out / "junit.xml"))
    assert (junit.tests, junit.failures) == (len(run.gates), len(failed))
    cases = [case for part in junit for case in part]
    assert [case.name.split()[0] for case in cases if case.result] == failed
    assert pd.read_parquet(out / "results.parquet").shape[0] == len(run.records)
    page = (out / "index.html").read_text(encoding="utf-8")
    summary = (out / "summary.md").read_text(encoding="utf-8")
    for gate in run.gates:
        assert gate.gate.score in page
        assert gate.gate.score in summary
    assert ("✓ Passed" in page) is run.passed
    assert ("**passed**" in summary) is run.passed


def test_the_page_needs_nothing_else_and_is_well_formed(run, tmp_path) -> None:
    write(run, tmp_path / "run")
    page = (tmp_path / "run" / "index.html").read_text(encoding="utf-8")
    links = _Links()
    links.feed(page)
    assert links.open == []
    assert links.links
    assert all(link.startswith("data:") for link in links.links)
    assert not re.search(r"@import|url\(|<script", page)
    assert "nan" not in re.sub(r"<style>.*?</style>|data:[^\"]*", "", page, flags=re.S).lower()
    assert len(page) < 5_000_000


def test_equal_runs_write_equal_scores(run, tmp_path) -> None:
    write(run, tmp_path / "one")
    write_run(run, tmp_path / "two", command="another", seconds=9.0)
    first, second = (tmp_path / name / "scores.json" for name in ("one", "two"))
    assert first.read_bytes() == second.read_bytes()


def test_an_earlier_run_is_replaced_and_the_rest_stays(run, tmp_path) -> None:
    write(run, tmp_path)
    (tmp_path / "notes.txt").write_text("mine", encoding="utf-8")
    (tmp_path / "index.html").write_text("old", encoding="utf-8")
    write(run, tmp_path)
    assert (tmp_path / "index.html").read_text(encoding="utf-8") != "old"
    assert {file.name for file in tmp_path.iterdir()} == FILES | {"notes.txt"}


def test_other_folders_and_files_are_refused(tmp_path) -> None:
    (tmp_path / "thesis.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(InputError, match="--out: expected an empty folder"):
        check_target(tmp_path)
    with pytest.raises(InputError, match="--out: expected a folder, found the file"):
        check_target(tmp_path / "thesis.txt")
    with pytest.raises(InputError, match="--out"):
        check_target(tmp_path / "thesis.txt" / "run")
    (tmp_path / "scores.json").write_text('{"format": "another"}', encoding="utf-8")
    with pytest.raises(InputError, match="--out"):
        check_target(tmp_path)
    (tmp_path / "empty").mkdir()
    check_target(tmp_path / "empty")


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0.000"), (-0.25, "−0.250"), (123.4, "123"), (2e-5, "2.0e−05"), (float("nan"), "–")],
)
def test_numbers_for_reading(value, text) -> None:
    assert number(value) == text


def test_intervals_for_reading() -> None:
    assert interval(0.1, 0.2) == "0.100 … 0.200"
    assert interval(float("nan"), 0.2) == ""


def test_crop_box_keeps_every_label_inside_the_image() -> None:
    labels = np.zeros((100, 200), np.int32)
    assert crop_box(labels) == (0, 100, 0, 200)
    labels[0:10, 100:150] = 3
    top, bottom, left, right = crop_box(labels)
    assert (top, left, right) == (0, 92, 158)
    assert bottom == 18


def test_compress_scales_the_cut_to_the_overlay() -> None:
    shown = picture()
    decoded = cv2.imdecode(np.frombuffer(shown.jpeg, np.uint8), cv2.IMREAD_COLOR)
    assert decoded.shape == (shown.height_px, shown.width_px, 3)
    assert (shown.width_px, shown.height_px) == (92, 72)  # 30 + 16 by 20 + 16 labels, twice


def test_a_chart_marks_every_finite_point() -> None:
    points = Points(
        x=np.array([0.1, 0.2, np.nan]),
        y=np.array([1.0, 500.0, 3.0]),
        view=np.array([0, 7, 1]),
        label=("a & b", "c", "d"),
    )
    svg = str(scatter(points, x_title="x", y_title="y", summary="s"))
    assert svg.count("<title>") == 2
    assert "a &amp; b" in svg
    assert "(log)" in svg
    nothing = Points(x=np.array([np.nan]), y=np.array([1.0]), view=np.array([0]), label=("",))
    assert "Nothing was measured" in scatter(nothing, x_title="x", y_title="y", summary="s")


@pytest.mark.parametrize("values", [[2.0], [2.0, 2.0], [0.0, 0.0], [-5.0, 7.0], [1e-9, 1e9]])
def test_axes_of_any_values_have_marks(values) -> None:
    y = np.array(values)
    points = Points(x=y, y=y, view=np.zeros(y.size, np.intp), label=("",) * y.size)
    svg = str(scatter(points, x_title="x", y_title="y", summary="s"))
    assert svg.count('class="grid"') >= 4
    assert "nan" not in svg


def test_ranks_do_not_shift_for_a_missing_rock() -> None:
    scene = pd.DataFrame(
        {
            "view": [0, 0, 0, 1, 1, 1],
            "method": "paper",
            "instance": [0, 1, 2, 0, 1, 2],
            "rock": [4, 5, 6, 1, 2, 3],
            "status": "matched",
            "eligible": True,
            "truth_angularity": [0.9, 0.5, 0.1] * 2,
            "angularity_2d_deg": [9.0, 5.0, 7.0, 9.0, np.nan, 1.0],
        }
    )
    table = rank_table(scene, Claim("yard", "", "paper", "angularity_2d_deg", "truth_angularity"))
    assert [row.instance for row in table.rows] == [0, 1, 2]
    assert [cell.rock for cell in table.rows[0].cells] == [4, 1]
    assert [[cell.off for cell in row.cells] for row in table.rows] == [[0, 0], [1, None], [1, 0]]
