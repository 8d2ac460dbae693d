"""Lock of a run's folder, and what a broken run leaves there."""

import shutil

import pytest

from rockshape.cli import main
from synth.dataset.folder_lock import folder_lock
from validation.api import run
from validation.errors import InputError
from validation.execution.store import FOLDER
from validation.report import check_target

SUITE = """
name = "drawn"
title = "Drawn"
[[experiment]]
kind = "shapes"
name = "s"
title = "S"
seed = 12000
drawings = 1
series = ["roundness"]
[[gate]]
score = "s.roundness.angularity_2d_deg.tau"
at_least = -1.0
reason = "any order"
"""


@pytest.fixture
def suite(tmp_path) -> str:
    (tmp_path / "drawn.toml").write_text(SUITE, encoding="utf-8")
    return str(tmp_path / "drawn.toml")


def test_a_second_run_into_a_folder_is_refused_in_one_line(suite, tmp_path, capsys) -> None:
    out = tmp_path / "out"
    command = ["validate", "run", "--suite", suite, "--out", str(out), "--jobs", "1"]
    assert main(command) == 0
    before = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
    capsys.readouterr()
    with folder_lock(out):
        for words in (command, [*command, "--resume"]):
            assert main(words) == 2
            said = capsys.readouterr()
            assert said.out == ""
            assert said.err == (
                f"rockshape: --out: {out}: expected a folder that no other run writes to, "
                "found one at work\n"
            )
        with pytest.raises(InputError, match="found one at work"):
            run(suite, out=out)
    assert {path: path.read_bytes() for path in out.rglob("*") if path.is_file()} == before


def test_a_run_that_was_broken_off_anywhere_can_be_resumed(suite, tmp_path) -> None:
    out = tmp_path / "out"
    run(suite, out=out, jobs=1)
    whole = {path.name for path in out.iterdir()}
    for names in ({FOLDER}, {FOLDER, "junit.xml"}, {FOLDER, "junit.xml", "results.parquet"}):
        broken = tmp_path / "-".join(sorted(names))
        shutil.copytree(out, broken)
        for name in whole - names:
            (broken / name).unlink()
        (broken / ".draft-x").mkdir()
        (broken / FOLDER / "format.json").write_text("", encoding="utf-8")
        if names == {FOLDER}:
            shutil.rmtree(broken / FOLDER)
            (broken / FOLDER).mkdir()
            (broken / FOLDER / "format.json.1.partial").write_bytes(b"{")
        else:
            shutil.copy(out / FOLDER / "format.json", broken / FOLDER / "format.json")
        check_target(broken)
        run(suite, out=broken, jobs=1, resume=True)
        assert {path.name for path in broken.iterdir()} == whole
        for name in ("scores.json", "results.parquet", "summary.md"):
            assert (broken / name).read_bytes() == (out / name).read_bytes()
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / FOLDER).mkdir()
    (tmp_path / "mine" / FOLDER / "note.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(InputError, match="found other files"):
        check_target(tmp_path / "mine")
