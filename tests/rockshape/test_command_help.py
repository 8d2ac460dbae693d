"""Help of `rockshape measure` and `rockshape formats`: at once, with examples, current."""

import subprocess
import sys

import pytest

from rockshape.cli import main
from rockshape.io import known_formats
from rockshape.io.registry import REGISTRIES
from rockshape.method import methods

HEAVY = ("numpy", "cv2", "pandas", "scipy", "PIL", "matplotlib", "skimage", "msgspec")


@pytest.mark.parametrize("command", ["measure", "formats", "fuse"])
def test_help_imports_nothing_heavy(command: str) -> None:
    code = f"""
import sys
from rockshape.cli import main
try:
    main(["{command}", "--help"])
except SystemExit as end:
    assert end.code == 0
print("loaded:", *(name for name in {HEAVY!r} if name in sys.modules))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "loaded:"


def help_of(capsys: pytest.CaptureFixture[str], command: str) -> str:
    with pytest.raises(SystemExit) as end:
        main([command, "--help"])
    assert end.value.code == 0
    return capsys.readouterr().out


@pytest.mark.parametrize("command", ["measure", "formats", "fuse"])
def test_help_has_two_examples(capsys: pytest.CaptureFixture[str], command: str) -> None:
    text = help_of(capsys, command)
    examples = text.partition("examples:\n")[2].splitlines()
    assert [line.startswith(f"  rockshape {command}") for line in examples] == [True, True]


def test_the_methods_are_in_the_help(capsys: pytest.CaptureFixture[str]) -> None:
    text = help_of(capsys, "measure")
    for name in methods():
        assert f"{name}," in text


def test_formats_lists_every_format_under_its_kind(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["formats"]) == 0
    blocks = capsys.readouterr().out.split("\n\n")
    kinds = ["image", "labels", "range", "camera", "table"]
    assert [block.splitlines()[0] for block in blocks] == kinds
    assert [registry.kind for registry in REGISTRIES] == kinds
    for block in blocks:
        kind, heading, *rows = block.splitlines()
        names = [each.name for each in known_formats() if each.kind == kind]
        assert [row[2:].partition("  ")[0] for row in rows] == names
        # aligned: the suffixes begin in the heading's column
        column = heading.index("suffixes")
        first = [row[column:].partition(" ")[0] for row in rows]
        assert all(word[:1] == "." or word == "folder" for word in first)
        assert all(row[column - 1] == " " for row in rows)


def test_formats_of_one_kind(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["formats", "table"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "table"
    assert [line.split()[0] for line in lines[2:]] == ["CSV", "JSON", "Parquet"]
