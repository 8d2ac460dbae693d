"""A kind of experiment from outside the packages, in one file, from its suite to a comparison."""

import json
import sys
from pathlib import Path

import pandas as pd
import pytest

from rockshape.cli import main
from validation.suite import registry
from validation.suite.plugins import load_plugin

KIND = '''
"""Kind from outside: coins of known diameter, measured with a ruler that may be too long."""

import pandas as pd
from markupsafe import Markup

from validation.execution.units import UnitResult
from validation.scores.judge import Feeds
from validation.scores.score import Definition, Estimate, Key
from validation.suite.experiment import Experiment
from validation.suite.kind import Kind
from validation.suite.registry import register_kind

DIAMETERS_MM = (16.25, 18.75, 21.25, 25.75)


class CoinsExperiment(Experiment, frozen=True, kw_only=True, tag="coins"):
    throws: int
    ruler: float = 1.0

    @property
    def units(self):
        return tuple(("", throw) for throw in range(self.throws))

    def dependencies(self, series, scene):
        return self.plain(without=("title", "throws"))


KIND = register_kind(
    Kind(name="coins", spec=CoinsExperiment, work=__name__, judge=__name__, page=__name__)
)


def run(unit):
    e = unit.experiment
    place = {"experiment": e.name, "kind": "coins", "series": "", "scene": unit.scene}
    place |= {"seed": e.seed + unit.scene, "view": 0, "method": "ruler"}
    rows = [
        place
        | {"instance": i, "rock": i + 1, "status": "matched", "iou": 1.0, "eligible": True}
        | {"diameter_mm": e.ruler * d + 0.01 * unit.scene, "truth_diameter_mm": d}
        for i, d in enumerate(DIAMETERS_MM)
    ]
    return UnitResult(pd.DataFrame(rows), pictures=(), backend="")


def claims(experiment, measures):
    return ()


view_claims = ranked_claims = claims


def definitions(experiment, measures):
    def error(records):
        own = records[records["experiment"] == experiment.name]
        off = (own["diameter_mm"] - own["truth_diameter_mm"]).abs()
        return Estimate(float(off.max(skipna=False)), len(own))

    key = Key(experiment.name, "ruler", "", "diameter_mm", "error")
    return (Definition(key, "ruler: greatest error", "mm", "coins", "lower", error),)


def _lost(records):
    return records.assign(diameter_mm=float("nan"))


FEEDS = Feeds(
    oracle=lambda records, claims: records.assign(diameter_mm=records["truth_diameter_mm"]),
    shuffled=lambda records, rng: _lost(records),
    mixed=lambda records, claims, rng: _lost(records),
)


def scenes_shown(experiment):
    return None


def section(run, experiment, room):
    return Markup(f'<section id="at-{experiment.name}"><h2>{experiment.title}</h2></section>')
'''
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
    (tmp_path / "coins_kind.py").write_text(KIND, encoding="utf-8")
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
