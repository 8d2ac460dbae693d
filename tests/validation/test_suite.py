"""Suite files: those of the package are whole, and a user's mistake is named."""

import tomllib
from importlib.resources import files

import pytest

from validation.errors import InputError
from validation.scores.scoring import definitions
from validation.suite.gates import check_names
from validation.suite.shipped import suite_names
from validation.suite.suite import as_suite, load_gates, load_suite

CI = (files("validation") / "suites" / "ci.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", suite_names())
def test_every_suite_is_whole(name) -> None:
    suite = load_suite(name)
    assert suite.name == name
    known = [definition.name for definition in definitions(suite)]
    assert len(set(known)) == len(known)
    check_names(suite.gates, known, where=name)
    assert all(experiment.seed >= 10000 for experiment in suite.experiments)


def test_the_suites_of_the_contract_are_there() -> None:
    assert {
        "ci",
        "full",
        "garden",
        "outlines",
        "segmentation",
        "shapes-roundness",
        "shapes-sphericity",
        "yard",
    } <= set(suite_names())


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        (
            "scenes =",
            "scnes =",
            r"unknown key 'scnes' in \[experiment\[0\]\]; did you mean 'scenes'\?",
        ),
        (
            "count = 6",
            "cuont = 6",
            r"unknown key 'cuont' in \[experiment\[0\].scene.rocks\]; did you mean 'count'\?",
        ),
        ("seed = 10000", "seed = -1", r"experiment\[0\].seed: expected"),
        (
            'kind = "multiview"',
            'kind = "multivew"',
            r"experiment\[0\].kind: expected one of .*; did you mean 'multiview'\?",
        ),
        ('kind = "multiview"\n', "", r"experiment\[0\].kind: expected one of"),
        ('kind = "multiview"', 'kind = "garden"', "expected 'pan', found"),
        ("count = 6", "count = -1", r"experiment\[0\].scene.rocks.count: expected"),
        ("seed = 10000", 'seed = 10000\nmethods = ["papr"]', "did you mean 'paper'"),
        (
            "[experiment.scene.rocks]",
            "[experiment.scene]\nseed = 3\n[experiment.scene.rocks]",
            "seed",
        ),
        ('name = "form"', 'name = "yard"', "differ"),
        ("reason =", "why =", r"unknown key 'why' in \[gate\[0\]\]"),
    ],
)
def test_a_bad_key_is_named(tmp_path, old, new, named) -> None:
    assert old in CI
    path = tmp_path / "bad.toml"
    path.write_text(CI.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(InputError, match=named) as error:
        load_suite(str(path))
    assert str(error.value).startswith(str(path))


def test_a_suite_without_gates_tells_the_faults_of_its_experiments_first() -> None:
    table = tomllib.loads(CI)
    del table["gate"]
    with pytest.raises(InputError, match=r"^mine: gate: expected a list of at least 1"):
        as_suite(table, where="mine")
    table["experiment"][0]["seed"] = -1
    with pytest.raises(InputError, match=r"^mine: experiment\[0\]\.seed: expected"):
        as_suite(table, where="mine")


def test_no_such_suite() -> None:
    with pytest.raises(
        InputError, match=r"suite \(--suite\): expected one of burial, ci, .*found 'nope'"
    ):
        load_suite("nope")


@pytest.mark.parametrize("content", [None, b"", b"a = [", b"\xff\xfe\x00"])
def test_unreadable_files(tmp_path, content) -> None:
    path = tmp_path / "x.toml"
    if content is not None:
        path.write_bytes(content)
    for load in (load_gates, lambda p: load_suite(str(p))):
        with pytest.raises(InputError, match=r"expected|missing"):
            load(path)


def test_a_folder_for_a_file(tmp_path) -> None:
    with pytest.raises(InputError, match="directory"):
        load_gates(tmp_path)
