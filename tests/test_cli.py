"""Frame of the command line: help, version, and suggestions for misspelt words."""

import subprocess
import sys
from importlib.metadata import version

import pytest

from rockshape.cli import main


def test_without_arguments_the_help_is_printed(capsys):
    assert main([]) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    assert printed.out.startswith("usage: rockshape")
    for command in ("measure", "synth", "validate"):
        assert f"\n    {command} " in printed.out


def test_version_is_the_distributions():
    command = [sys.executable, "-m", "rockshape.cli", "--version"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout == f"rockshape {version('rockshape')}\n"


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        ("mesure", "rockshape: unknown command 'mesure'; did you mean 'measure'?"),
        ("zzz", "rockshape: unknown command 'zzz'; expected formats, measure, synth or validate"),
        ("--vresion", "rockshape: unknown option '--vresion'; did you mean '--version'?"),
        (
            "measure a.png --mehtod=paper",
            "rockshape measure: unknown option '--mehtod'; did you mean '--method'?",
        ),
        ("measure a.png b.png", "rockshape measure: unknown argument 'b.png'"),
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
