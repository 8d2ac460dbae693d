"""Benchmarks: their runner, their results, and the tables that docs quote of them."""

import inspect
import json
import re
import socket
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
FOLDER = ROOT / "benchmarks"
DOCS = sorted((ROOT / "docs").glob("*.md"))


@pytest.fixture(scope="module", autouse=True)
def _importable():
    """Let the tests import the runner as the command does."""
    sys.path.insert(0, str(FOLDER))
    yield
    sys.path.remove(str(FOLDER))


@pytest.fixture(scope="module")
def cases():
    from run import all_cases

    return all_cases()


@pytest.fixture
def toy():
    """A case that takes no time and reports what it was given."""
    from case import Case, Column, Table

    def run(*, rows=3):
        columns = (Column("name"), Column("time", "ms", ".2f"), Column("ratio"))
        return [Table(columns, [(f"row {n}", 1.5 * n, None) for n in range(rows)])]

    return Case(name="toy", what="nothing", run=run, smallest={"rows": 1}, peer="itself")


def entry(**changes):
    """An entry of results.json."""
    return {
        "what": "nothing",
        "size": "full",
        "peer": "",
        "threads": 1,
        "machine": {"cpu": "Abacus 9", "cores": 2, "load": 0.3},
        "date": "2026-01-02",
        "versions": {"rockshape": "1", "python": "3", "numpy": "2", "scipy": "1"},
        "tables": [
            {
                "name": "",
                "columns": [["work", "", ""], ["time", "ms", ".1f"], ["size", "px", ""]],
                "rows": [["a", 1.25, 91234.0], ["b", None, 0.012345]],
            }
        ],
    } | changes


def test_every_region_in_docs_is_what_the_results_say():
    from results import load_results
    from tables import documents, filled

    results = load_results()
    for path in documents():
        text = path.read_text(encoding="utf-8")
        assert filled(text, results) == text, f"{path.name}: run python benchmarks/tables.py"


def test_docs_hold_regions_of_results():
    from tables import REGION

    named = {match[1] for path in DOCS for match in REGION.finditer(path.read_text("utf-8"))}
    assert len(named) > 10
    for path in DOCS:
        text = path.read_text("utf-8")
        assert text.count("<!-- benchmark:") == len(REGION.findall(text)), path.name


def test_every_case_and_script_that_is_named_exists(cases):
    from draw import PICTURES

    files = [*DOCS, ROOT / "README.md", *(ROOT / "tests").rglob("*.py")]
    files += [
        one for part in ("rockshape", "synth", "validation") for one in (ROOT / part).rglob("*.py")
    ]
    for path in set(files) - {Path(__file__)}:
        text = re.sub(r"\s+", " ", path.read_text("utf-8"))
        for script, words in re.findall(r"benchmarks/(\w+)\.py((?: [a-z]\w*)*)", text):
            assert (FOLDER / f"{script}.py").exists(), f"{path}: benchmarks/{script}.py"
            known = {"run": cases, "draw": PICTURES}.get(script, {})
            if known and words:
                assert words.split()[0] in known, f"{path}: {script}.py{words}"


def test_each_result_belongs_to_a_case_at_its_full_size(cases):
    from results import load_results

    results = load_results()
    assert list(results) == sorted(results)
    for name, one in results.items():
        assert one["size"] == "full", name
        assert one["what"] == cases[name].what, name
        assert one["peer"] == cases[name].peer, name
        for table in one["tables"]:
            assert table["rows"], name
            assert {len(row) for row in table["rows"]} == {len(table["columns"])}, name


def test_results_tell_the_machine_but_neither_its_name_nor_its_paths():
    text = (FOLDER / "results.json").read_text("utf-8")
    for one in json.loads(text).values():
        assert one["machine"]["cores"] >= 1
        assert one["machine"]["cpu"]
        assert one["versions"]["numpy"]
    assert not re.search(r"/(home|root|tmp|usr|work)/", text)
    assert socket.gethostname() not in text


def test_every_case_has_a_smallest_size_with_the_options_of_its_full_one(cases):
    assert len(cases) > 20
    for case in cases.values():
        options = inspect.signature(case.run).parameters
        assert set(case.smallest) == set(options), case.name
        assert all(one.default is not one.empty for one in options.values()), case.name


def test_a_run_replaces_its_entry_and_leaves_the_others(tmp_path, toy, capsys):
    from results import load_results, save_entry
    from run import run_case

    out = tmp_path / "results.json"
    save_entry("zebra", entry(), out)
    save_entry("toy", entry(date="1999-01-01"), out)
    save_entry("ant", entry(), out)
    run_case(toy, smallest=False, out=out)
    found = load_results(out)
    assert list(found) == ["ant", "toy", "zebra"]
    assert found["ant"] == found["zebra"] == entry()
    table = found["toy"]["tables"][0]
    assert table["rows"] == [["row 0", 0.0, None], ["row 1", 1.5, None], ["row 2", 3.0, None]]
    assert found["toy"]["date"] > "2025"
    assert "| row 2 | 3.00 | – |" in capsys.readouterr().out


def test_the_smallest_size_is_not_kept(tmp_path, toy, capsys):
    from run import run_case

    run_case(toy, smallest=True, out=None)
    assert "toy (smallest" in capsys.readouterr().out
    assert not list(tmp_path.iterdir())


def test_a_table_in_markdown():
    from tables import markdown

    assert markdown(entry()["tables"][0]).splitlines() == [
        "| work | time, ms | size, px |",
        "| --- | --- | --- |",
        "| a | 1.2 | 91,200 |",
        "| b | – | 0.0123 |",
    ]


def test_a_region_is_filled_and_the_rest_is_left():
    from tables import filled

    text = "before\n<!-- benchmark: one -->\nold\n<!-- end -->\nafter\n"
    new = filled(text, {"one": entry(peer="cv2")})
    assert new.startswith("before\n<!-- benchmark: one -->\n\n| work |")
    assert new.endswith("<!-- end -->\nafter\n")
    assert "old" not in new
    assert "ratios are to cv2; Abacus 9, 2 cores, 1 thread, load average 0.3" in new
    assert filled(new, {"one": entry(peer="cv2")}) == new


@pytest.mark.parametrize("name", ["two", "one.rows"])
def test_a_region_without_a_result_is_refused(name):
    from tables import filled

    with pytest.raises(SystemExit, match=f"region '{name}': expected"):
        filled(f"<!-- benchmark: {name} -->\n<!-- end -->", {"one": entry()})


def test_a_misspelt_case_is_refused_with_the_nearest_name(capsys):
    from run import main

    assert main(["elipsoid"]) == 2
    assert "unknown case 'elipsoid'; did you mean 'ellipsoid'?" in capsys.readouterr().err


@pytest.mark.parametrize("words", [[], ["--smallest", "--out", "results.json"]])
def test_figures_that_are_kept_are_not_taken_side_by_side(words, capsys):
    from run import main

    with pytest.raises(SystemExit):
        main(["--jobs", "2", *words])
    assert "--jobs: expected --smallest" in capsys.readouterr().err


def test_a_row_of_the_wrong_length_is_refused():
    from case import Column, Table

    with pytest.raises(ValueError, match="expected 2 cells, found 1"):
        Table((Column("a"), Column("b")), [("x",)])


def test_times_tell_waiting_from_working():
    from timing import best_of

    def work():
        end = time.process_time() + 0.02
        while time.process_time() < end:
            pass

    found = best_of(2, {"wait": lambda: time.sleep(0.05), "work": work})
    assert found["wait"].wall_s >= 0.05
    assert found["wait"].cpu_s < 0.02
    assert 0.02 <= found["work"].cpu_s < 0.04


def test_a_child_process_is_timed_with_its_own_processor_time():
    from timing import timed_command

    idle = timed_command([sys.executable, "-c", "import time; time.sleep(0.3)"])
    assert idle.wall_s >= 0.3
    assert 0 < idle.cpu_s < idle.wall_s - 0.2
