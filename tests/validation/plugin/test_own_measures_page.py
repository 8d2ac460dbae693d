"""docs/own-measures.md: its code is run as it stands, from an empty folder to red and green."""

import re
import shlex
from pathlib import Path

import pytest

from validation.peers.function import load_function

pytest_plugins = ["pytester"]

ROOT = Path(__file__).parents[3]
PAGE = (ROOT / "docs" / "own-measures.md").read_text(encoding="utf-8")
FILES = dict(re.findall(r"`(\S+)`:\n\n```\w+\n(.*?)```", PAGE, re.DOTALL))
PYTHON = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
SHELL = re.findall(r"```sh\n(.*?)```", PAGE, re.DOTALL)
FAILURE = re.findall(r"```text\n(.*?)```", PAGE, re.DOTALL)
GREEN, TESTS = PYTHON[1:]


@pytest.fixture
def folder(pytester):
    """An empty folder with the page's files in it."""
    load_function.cache_clear()
    for name, text in FILES.items():
        (pytester.path / name).write_text(text, encoding="utf-8")
    return pytester


def _correct(folder) -> None:
    measures = folder.path / "my_measures.py"
    *kept, _ = measures.read_text(encoding="utf-8").splitlines(keepends=True)
    measures.write_text("".join([*kept, GREEN]), encoding="utf-8")
    load_function.cache_clear()


def test_from_an_empty_folder_to_red_and_green_in_under_15_lines(folder) -> None:
    assert sorted(FILES) == ["my.toml", "my_measures.py"]
    program, *words = shlex.split(SHELL[1])
    assert (program, words[0]) == ("pytest", "--rockshape-suite")
    red = folder.runpytest_inprocess(*words)
    assert red.ret == pytest.ExitCode.TESTS_FAILED
    red.stdout.fnmatch_lines(FAILURE[0].splitlines())
    _correct(folder)
    green = folder.runpytest_inprocess(*words)
    assert green.ret == pytest.ExitCode.OK
    green.assert_outcomes(passed=1)
    lines = [line for text in (*FILES.values(), *SHELL) for line in text.splitlines() if line]
    assert len(lines) < 15


def test_the_tests_of_the_page_pass(folder) -> None:
    _correct(folder)
    (folder.path / "test_page.py").write_text(TESTS, encoding="utf-8")
    folder.runpytest_inprocess("-W", "error").assert_outcomes(passed=1)


def test_the_options_of_the_page_are_the_plug_ins(folder) -> None:
    told = set(re.findall(r"^\| `(--[\w-]+)", PAGE, re.MULTILINE))
    shown = set(
        re.findall(r"--rockshape-[\w-]+", folder.runpytest_inprocess("--help").stdout.str())
    )
    assert told == shown
