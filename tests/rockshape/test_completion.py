"""`rockshape completion`: what bash offers after the words that stand there."""

import shutil
import subprocess

import pytest

from rockshape.cli import main
from rockshape.commands.completion import script
from rockshape.commands.known import command_names

BASH = shutil.which("bash")


@pytest.fixture(scope="module")
def text() -> str:
    return script()


def offered(text: str, *words: str) -> list[str]:
    listed = " ".join(f"'{word}'" for word in ("rockshape", *words))
    ask = f"COMP_WORDS=({listed}); COMP_CWORD={len(words)}; _rockshape; echo ${{COMPREPLY[@]}}"
    done = subprocess.run(
        [str(BASH), "-c", f"{text}\n{ask}"], capture_output=True, text=True, check=True
    )
    assert done.stderr == ""
    return done.stdout.split()


@pytest.mark.skipif(BASH is None, reason="no bash")
@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["mea"], ["measure"]),
        (["measure", "--pie"], ["--pieces"]),
        (["measure", "--pieces", ""], ["split", "keep"]),
        (["measure", "a.png", "--pieces", "k"], ["keep"]),
        (["measure", "--range", ""], []),  # a file
        (["measure", ""], []),
        (["synth", "s"], ["scene", "shapes"]),
        (["synth", "scene", "--repl"], ["--replay"]),
        (["formats", "la"], ["labels"]),
        (["--ver"], ["--version"]),
    ],
)
def test_bash_offers(text: str, words: list[str], expected: list[str]) -> None:
    assert offered(text, *words) == expected


@pytest.mark.skipif(BASH is None, reason="no bash")
def test_all_commands_are_offered_at_first(text: str) -> None:
    assert sorted(offered(text, "")) == command_names()


def test_the_command_prints_it(capsys: pytest.CaptureFixture[str], text: str) -> None:
    assert main(["completion"]) == 0
    assert capsys.readouterr().out == text
