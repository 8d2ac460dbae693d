"""A kind of experiment from outside the packages, in one file, from its suite to a comparison."""

import json
import shutil
import sys
from pathlib import Path

import pandas as pd
import pytest

from rockshape.cli import main
from validation.suite import registry
from validation.suite.plugins import load_plugin

KIND = Path(__file__).parents[1] / "plugins" / "coins_kind.py"
SUITE = """
name = "coins"
title = "Coins"
plugins = ["coins_kind"]

[[experiment]]
kind = "coins"
name = "pocket"
title = "Coins of one pocket"
seed = 1
throws = 3
ruler = 1.0

[[gate]]
score = "pocket.ruler.diameter_mm.error"
at_most = 0.1
reason = "A ruler is read to a tenth of a millimetre."
"""


@pytest.fixture
def suite(tmp_path, monkeypatch) -> Path:
    """The suite's file beside the kind's, in the current folder."""
    monkeypatch.setattr(registry, "_registered", {})
    monkeypatch.delitem(sys.modules, "coins_kind", raising=False)
    load_plugin.cache_clear()
    shutil.copy(KIND, tmp_path)
    (tmp_path / "coins.toml").write_text(SUITE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    return tmp_path / "coins.toml"


def _run(suite: Path, out: str, *more: str) -> int:
    words = ["validate", "run", "--suite", str(suite), "--out", out, "--jobs", "1"]
    return main([*words, *more])


def test_a_kind_of_one_file_runs_gates_shows_resumes_and_compares(suite, capsys) -> None:
    assert _run(suite, "good") == 0
    records = pd.read_parquet("good/results.parquet")
    assert (len(records), set(records["kind"])) == (3 * 4, {"coins"})
    scores = json.loads(Path("good/scores.json").read_text(encoding="utf-8"))
    assert [score["value"] for score in scores["scores"]] == [pytest.approx(0.02, abs=1e-12)]
    assert [check["sound"] for check in scores["self_check"].values()] == [True, True, True]
    page = Path("good/index.html").read_text(encoding="utf-8")
    assert '<section id="at-pocket"><h2>Coins of one pocket</h2>' in page
    assert '<a href="#at-pocket">Pocket</a>' in page

    units = {path: path.stat().st_mtime_ns for path in Path("good").rglob("units/*/*.parquet")}
    more = suite.with_name("more.toml")
    more.write_text(SUITE.replace("throws = 3", "throws = 4"), encoding="utf-8")
    capsys.readouterr()
    assert _run(more, "good", "--resume") == 0
    assert "3 of 4 units are there already" in capsys.readouterr().err
    kept = {path: path.stat().st_mtime_ns for path in Path("good").rglob("units/*/*.parquet")}
    assert len(kept) == 4
    assert units.items() <= kept.items()

    long = suite.with_name("long.toml")
    long.write_text(SUITE.replace("throws = 3\nruler = 1.0", "throws = 4\nruler = 1.1"))
    assert _run(long, "bad") == 1
    assert "gate failed: pocket.ruler.diameter_mm.error" in capsys.readouterr().out
    assert main(["validate", "compare", "good", "bad"]) == 1
    told = capsys.readouterr().out
    assert "| worse | `pocket.ruler.diameter_mm.error` | 0.030 |" in told
    assert "gate passed before and fails now: `pocket.ruler.diameter_mm.error" in told


def test_a_misspelt_key_of_an_own_kind_is_named(suite, capsys) -> None:
    suite.write_text(SUITE.replace("throws =", "thorws ="), encoding="utf-8")
    assert _run(suite, "out") == 2
    error = capsys.readouterr().err
    assert "unknown key 'thorws' in [experiment[0]]; did you mean 'throws'?" in error
