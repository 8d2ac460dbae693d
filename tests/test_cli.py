"""Frame of the command line: help, version, and suggestions for misspelt words."""

import argparse
import subprocess
import sys
from collections.abc import Iterator
from importlib.metadata import version

import pytest

from rockshape.cli import build_parser, main

HEAVY = {"numpy", "cv2", "scipy", "pandas", "trimesh", "skimage", "matplotlib", "pyarrow"}


def _commands(parser: argparse.ArgumentParser, before: tuple[str, ...] = ()) -> Iterator[tuple]:
    """Yield the words of each command, of each action of a command and so on."""
    yield before
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for word, nested in action.choices.items():
                yield from _commands(nested, (*before, word))


COMMANDS = list(_commands(build_parser()))


def _python(*arguments: str) -> tuple[str, set[str]]:
    """What Python prints, and the packages that it imports."""
    command = [sys.executable, "-X", "importtime", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    modules = {line.rpartition("|")[2].strip() for line in done.stderr.splitlines()}
    return done.stdout, {module.partition(".")[0] for module in modules}


def _run(*arguments: str) -> tuple[str, set[str]]:
    printed, imported = _python("-m", "rockshape.cli", *arguments)
    assert "argparse" in imported
    return printed, imported


@pytest.mark.parametrize("package", ["rockshape", "synth", "validation"])
def test_importing_a_package_imports_nothing_heavy(package):
    _, imported = _python("-c", f"import {package}")
    assert package in imported
    assert imported & HEAVY == set()


def test_all_commands_are_seen():
    assert {("measure",), ("synth", "scene"), ("validate", "run")} <= set(COMMANDS)


@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_every_help_has_two_examples_and_imports_nothing_heavy(words):
    printed, imported = _run(*words, "--help")
    assert imported & HEAVY == set()
    examples = printed.partition("\nexamples:\n")[2].splitlines()
    beginning = " ".join(["  rockshape", *words])
    assert len(examples) == 2
    assert all(line.startswith(beginning) for line in examples), examples


def test_without_arguments_the_help_is_printed(capsys):
    assert main([]) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    assert printed.out.startswith("usage: rockshape")
    for command in ("measure", "synth", "validate"):
        assert f"\n    {command} " in printed.out


def test_the_version_is_the_distributions_and_imports_nothing_heavy():
    printed, imported = _run("--version")
    assert printed == f"rockshape {version('rockshape')}\n"
    assert imported & HEAVY == set()


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ("mesure", "rockshape: unknown command 'mesure'; did you mean 'measure'?"),
        (
            "zzz",
            "rockshape: unknown command 'zzz'; expected columns, completion, formats, fuse, "
            "measure, plot, rank, summarise, synth or validate",
        ),
        ("--vresion", "rockshape: unknown option '--vresion'; did you mean '--version'?"),
        (
            "measure a.png --mehtod=paper",
            "rockshape measure: unknown option '--mehtod'; did you mean '--method'?",
        ),
        ("synth scen out", "rockshape synth: unknown kind 'scen'; did you mean 'scene'?"),
        (
            "synth scene out --rokcs 3",
            "rockshape synth scene: unknown option '--rokcs'; did you mean '--rocks'?",
        ),
    ],
)
def test_a_misspelt_word_ends_in_one_line_with_the_nearest_known(arguments, line, capsys):
    with pytest.raises(SystemExit) as ended:
        main(arguments.split())
    assert ended.value.code == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    prog = line.partition(":")[0]
    assert printed.err == f"{line} (see {prog} --help)\n"
