"""Measures from elsewhere: functions, commands and peers, judged on the masks that ours have."""

import json
import sys

import numpy as np
import pandas as pd
import pytest

from rockshape.cli import main
from validation.errors import InputError
from validation.execution.units import Unit
from validation.execution.work import run_unit
from validation.kinds.multiview.spec import MultiviewExperiment
from validation.kinds.shapes.spec import ShapesExperiment
from validation.peers import MeasureSpec, Seen, run_measure, source_digest
from validation.peers.adapters import ADAPTERS
from validation.peers.parse import parse_measure, parse_traits, settle
from validation.peers.view_input import as_table
from validation.scores.scoring import claims_of, score_values
from validation.suite.gates import Gate
from validation.suite.suite import Suite

MODULE = """
import numpy as np
from validation.peers.declare import rises_with

def _boxes(labels):
    for number in np.unique(labels[labels > 0]):
        rows, cols = np.nonzero(labels == number)
        yield np.ptp(rows) + 1, np.ptp(cols) + 1

@rises_with(squareness="form")
def boxes(image, labels, points_m):
    return {"squareness": [min(box) / max(box) for box in _boxes(labels)], "extra": np.ones(
        len(np.unique(labels)) - 1)}

def bare(image, labels, points_m):
    return np.ones(len(np.unique(labels)) - 1)

def broken(image, labels, points_m):
    raise RuntimeError("no such luck")

def wrong(image, labels, points_m):
    return {"squareness": [1.0]}
"""
SCRIPT = """
import sys
import cv2, numpy as np, pandas as pd
image, labels, points, out = sys.argv[1:]
labels = cv2.imread(labels, cv2.IMREAD_UNCHANGED)
assert cv2.imread(image, cv2.IMREAD_UNCHANGED).shape == labels.shape
if points:
    assert np.load(points)["xyz"].shape == (*labels.shape, 3)
rocks = np.unique(labels[labels > 0])[::-1]
pd.DataFrame({"rock": rocks, "size": [(labels == r).sum() for r in rocks]}).to_csv(out, index=False)
"""


@pytest.fixture
def module(tmp_path, monkeypatch) -> str:
    """The name of a module of measures in the current folder."""
    name = f"mine_{tmp_path.name.replace('-', '_')}"
    (tmp_path / f"{name}.py").write_text(MODULE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    return name


@pytest.fixture
def command(tmp_path) -> str:
    """A command that measures sizes."""
    (tmp_path / "sizes.py").write_text(SCRIPT, encoding="utf-8")
    return f"{sys.executable} {tmp_path / 'sizes.py'} {{image}} {{labels}} {{range}} {{out}}"


@pytest.fixture
def seen() -> Seen:
    """Two rocks, numbered 3 and 7: 4 × 8 and 5 × 5 pixels."""
    labels = np.zeros((40, 60), np.int32)
    labels[5:9, 5:13], labels[20:25, 30:35] = 3, 7
    return Seen(np.zeros((40, 60), np.float32), labels, np.ones((40, 60, 3)))


def test_a_function_and_what_it_says_of_itself(module, seen) -> None:
    spec = settle(parse_measure(f"{module}:boxes"), {})
    assert (spec.name, spec.expected_trait) == ("boxes", {"squareness": "form"})
    table = run_measure(spec, seen)
    assert table["rock"].to_list() == [3, 7]
    assert table["squareness"].to_list() == [0.5, 1.0]


def test_an_array_alone_is_a_value(module, seen) -> None:
    spec = settle(parse_measure(f"plain={module}:bare"), {"value": "angularity"})
    assert (spec.name, spec.expected_trait) == ("plain", {"value": "angularity"})
    assert run_measure(spec, seen)["value"].to_list() == [1.0, 1.0]


def test_a_command_with_range_and_without(command, seen) -> None:
    spec = settle(parse_measure(f"sizes={command}"), {"size": "form"})
    assert run_measure(spec, seen)["size"].to_list() == [32, 25]
    without = Seen(seen.image, seen.labels, None)
    assert run_measure(spec, without)["size"].to_list() == [32, 25]


def test_the_source_counts_for_what_is_kept(command, tmp_path) -> None:
    spec = parse_measure(f"sizes={command}")
    before = source_digest(spec)
    assert source_digest(spec) == before
    (tmp_path / "sizes.py").write_text(SCRIPT + "\n", encoding="utf-8")
    assert source_digest(spec) != before


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("nope", "expected package.module:function"),
        ("no.such.module:f", "can be imported"),
        ("json:nope", "function nope"),
        ("./m {labels}", "{out}"),
        ("./m '{labels} {out}", "expected a command"),
        ("paper=./m {labels} {out}", "no method has"),
        ("./no-such-program {labels} {out}", "no-such-program"),
        ("false {labels} {out}", "ended with 1"),
        ("true {labels} {out}", "CSV"),
        ("{module}:broken", "no such luck"),
        ("{module}:wrong", "one number for each of 2 rocks"),
        ("{module}:bare", "--expected-trait"),
    ],
)
def test_what_does_not_work_is_found_out_before_any_work(text, said, module) -> None:
    with pytest.raises(InputError) as error:
        settle(parse_measure(text.replace("{module}", module)), {})
    assert said in str(error.value)


def test_what_is_no_number_a_rock_is_refused() -> None:
    numbers = np.array([3, 7])
    for given, said in (
        ({"a": ["x", "y"]}, "numbers"),
        (pd.DataFrame({"rock": [3, 9], "a": [1, 2]}), "rock"),
        (pd.DataFrame({"rock": [3, 3], "a": [1, 2]}), "rock"),
        (np.ones((2, 2)), "one number"),
    ):
        with pytest.raises(InputError, match=said):
            as_table(given, numbers, where="m")
    fewer = as_table(pd.DataFrame({"rock": [7], "a": [2.0]}), numbers, where="m")
    assert np.isnan(fewer["a"][0])
    assert fewer["a"][1] == 2.0


def test_expected_traits_by_column() -> None:
    assert parse_traits(["a=form", "b=roundness"]) == {"a": "form", "b": "roundness"}
    for text in ("a", "a=size", "=form"):
        with pytest.raises(InputError, match="--expected-trait"):
            parse_traits([text])


def test_peers_stand_beside_ours_on_the_same_masks() -> None:
    peer = settle(parse_measure("scikit-image"), {})
    drawings = ShapesExperiment(name="s", title="S", seed=10900, drawings=1)
    yard = MultiviewExperiment(name="y", title="Y", seed=1, scenes=1, varied=("angularity",))
    gate = Gate(score="s.x", at_least=0, reason="r")
    suite = Suite(name="s", title="S", experiments=(drawings,), gates=(gate,), measures=(peer,))
    judged = {claim.measure for claim in claims_of(suite, yard) if claim.method == peer.name}
    assert judged == {"solidity", "circularity"}
    parts = [run_unit(Unit(drawings, series, 0, (peer,))) for series in drawings.series]
    records = pd.concat([part.records for part in parts], ignore_index=True)
    theirs = records[records["method"] == "scikit-image"]
    assert (theirs["iou"] == 1.0).all()
    assert theirs["rock"].to_list() == records[records["method"] == "paper"]["rock"].to_list()
    values = score_values(suite, records)
    # four shapes far apart in form, drawn from one rule
    assert values["s.scikit-image.sphericity.axis_ratio.tau"] == 1.0
    assert values["s.scikit-image.roundness.circularity.tau"] == 1.0


@pytest.mark.parametrize("name", sorted(set(ADAPTERS) - {"scikit-image"}))
def test_a_peer_that_is_installed_ranks_drawn_forms(name) -> None:
    pytest.importorskip(name)
    peer = settle(parse_measure(name), {})
    drawings = ShapesExperiment(name="s", title="S", seed=10900, drawings=1, series=("sphericity",))
    gate = Gate(score="s.x", at_least=0, reason="r")
    suite = Suite(name="s", title="S", experiments=(drawings,), gates=(gate,), measures=(peer,))
    values = score_values(suite, run_unit(Unit(drawings, "sphericity", 0, (peer,))).records)
    taus = [v for key, v in values.items() if key.startswith(f"s.{name}.") and key.endswith(".tau")]
    assert max(taus) == 1.0


def test_names_must_differ(capsys, tmp_path) -> None:
    words = ["validate", "run", "--suite", "shapes-roundness", "--out", str(tmp_path / "out")]
    twice = ["--measure", "scikit-image", "--measure", "scikit-image"]
    assert main([*words, *twice]) == 2
    assert "NAME=" in capsys.readouterr().err
    assert main([*words, "--measure", "scikit-image", "--rises-with", "nope=form"]) == 2
    assert "nope" in capsys.readouterr().err


def test_a_measure_in_a_suite_file_is_a_function_or_a_command() -> None:
    for both in ({}, {"command": "x", "function": "y:z"}):
        with pytest.raises(ValueError, match="a function or a command"):
            MeasureSpec(name="m", **both)


def test_the_leaderboard_is_printed_and_written(tmp_path, capsys) -> None:
    suite = tmp_path / "drawings.toml"
    suite.write_text(
        'name = "d"\ntitle = "D"\n[[experiment]]\nkind = "shapes"\nname = "s"\ntitle = "S"\n'
        'seed = 10900\ndrawings = 2\n[[gate]]\nscore = "s.scikit-image.roundness.solidity.tau"\n'
        'at_least = -1.0\nreason = "it can be gated like ours"\n',
        encoding="utf-8",
    )
    out = tmp_path / "out"
    words = ["validate", "run", "--suite", str(suite), "--out", str(out), "--jobs", "1"]
    assert main([*words, "--measure", "scikit-image"]) == 0
    said = capsys.readouterr().out
    assert "### s: order by form" in said
    assert "| scikit-image | `axis_ratio` | 1.000 |" in said
    assert said.split("\n\n")[0] in (out / "summary.md").read_text(encoding="utf-8")
    assert "scikit-image" in (out / "index.html").read_text(encoding="utf-8")
    scores = json.loads((out / "scores.json").read_text(encoding="utf-8"))
    assert scores["spec"]["measure"][0]["expected_trait"]["solidity"] == "roundness"
