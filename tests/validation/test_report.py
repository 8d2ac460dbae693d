"""A run's folder: its five files agree, need nothing else, and replace only an earlier run."""

import json
import re
from html.parser import HTMLParser

import numpy as np
import pandas as pd
import pytest
from junitparser import JUnitXml

from tests.validation.pictured import units
from validation.errors import InputError
from validation.execution.run import assess
from validation.report import check_target, write_run
from validation.report.charts import CELLS, Points, scatter, span
from validation.report.format import interval, number
from validation.report.rank_table import rank_table
from validation.scores.expectations import Claim
from validation.selfcheck.oracle import oracle

FILES = {"index.html", "scores.json", "results.parquet", "junit.xml", "summary.md"}


@pytest.fixture(scope="module", params=["noise", "oracle"])
def run(request, suite, claims, noise):
    records = oracle(noise, claims) if request.param == "oracle" else noise
    return assess(suite, suite.gates, units(records))


class _Links(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.links: list[str] = []
        self.names: list[str] = []
        self.open: list[str] = []

    def handle_starttag(self, tag, attrs) -> None:
        self.links += [value for name, value in attrs if name in {"src", "href"}]
        self.names += [value for name, value in attrs if name == "id"]
        if tag not in {"meta", "br", "img", "wbr", "input"}:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs) -> None:
        self.handle_starttag(tag, attrs)
        self.open = self.open[: -1 if self.open[-1:] == [tag] else None]

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
    assert ("gates passed</h1>" in page) is run.passed
    assert ("**passed**" in summary) is run.passed


def test_the_page_needs_nothing_else_and_is_well_formed(run, tmp_path) -> None:
    write(run, tmp_path / "run")
    page = (tmp_path / "run" / "index.html").read_text(encoding="utf-8")
    links = _Links()
    links.feed(page)
    assert links.open == []
    assert links.links
    assert all(link.startswith(("data:image/jpeg;base64,", "#")) for link in links.links)
    assert all(link[1:] in links.names for link in links.links if link.startswith("#"))
    assert len(links.names) == len(set(links.names))
    assert not re.search(r"@import|url\(|<script src|https?:", page)
    told = re.sub(r"<style>.*?</style>|<script>.*?</script>|data:[^\"]*", "", page, flags=re.S)
    assert "nan" not in told.lower()
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


def points(x, y, *, drawn=None, place="rock-0") -> Points:
    rows = np.arange(len(x)) if drawn is None else np.array(drawn)
    return Points(
        x=np.array(x, dtype=np.float64),
        y=np.array(y, dtype=np.float64),
        drawn=rows,
        view=tuple(7 * int(row) for row in rows),
        label=tuple(f"a & {row}" for row in rows),
        place=(place,) * len(rows),
    )


def test_a_chart_marks_every_finite_point() -> None:
    three = points([0.1, 0.2, np.nan], [1.0, 500.0, 3.0])
    svg = str(scatter(three, x_title="x", y_title="y", summary="s"))
    assert svg.count("<title>") == svg.count('href="#rock-0"') == 2
    assert svg.count('tabindex="0"') == 1
    assert "a &amp; 1" in svg
    assert "y (log)" in svg
    assert "shade" not in svg
    nothing = points([np.nan], [1.0])
    assert "Nothing was measured" in scatter(nothing, x_title="x", y_title="y", summary="s")


def test_a_point_without_a_place_leads_to_the_words_that_say_so() -> None:
    lone = points([1.0, 2.0], [1.0, 2.0], place=None)
    svg = str(scatter(lone, x_title="x", y_title="y", summary="s", unshown="rule-yard"))
    assert svg.count('href="#rule-yard" class="bare"') == 2


def test_a_chart_of_many_points_shades_them_and_marks_few() -> None:
    rng = np.random.default_rng(3)
    many = points(rng.uniform(size=9000), rng.normal(size=9000), drawn=[5, 80])
    svg = str(scatter(many, x_title="x", y_title="y", summary="s"))
    assert svg.count("<title>") == 2
    cells = sum(d.count("M") for d in re.findall(r'class="shade s\d" d="([^"]*)"', svg))
    assert 100 < cells <= CELLS[0] * CELLS[1]
    assert len(svg) < 40_000


@pytest.mark.parametrize("values", [[2.0], [2.0, 2.0], [0.0, 0.0], [-5.0, 7.0], [1e-9, 1e9]])
def test_axes_of_any_values_have_marks(values) -> None:
    svg = str(scatter(points(values, values), x_title="x", y_title="y", summary="s"))
    assert svg.count('class="grid"') >= 4
    assert "nan" not in svg
    assert "−0<" not in svg


def test_a_span_shows_value_and_interval() -> None:
    shown = str(span(0.5, 0.0, 0.75, start=-1, end=1))
    assert 'cx="88.0"' in shown
    assert "M60.0 7H102.0" in shown
    assert span(float("nan"), 0, 1, start=0, end=1) == ""


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
