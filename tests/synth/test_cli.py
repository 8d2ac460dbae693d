"""The command line's contract: exit status 2 and 3 with one line, files where asked."""

import argparse
import shlex
import subprocess
import sys

import pytest

from rockshape.cli import main
from synth import cli
from synth.render import backends


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["scene", "--camera", "foo"], ["--camera", "imp", "msl-navcam", "'foo'"]),
        (["scene", "--site", "mars"], ["--site", "pathfinder", "plain", "'mars'"]),
        (["scene", "--renderer", "foo"], ["--renderer", "osmesa", "'foo'"]),
        (["scene", "--noise", "radar"], ["--noise", "none", "stereo", "sgm", "'radar'"]),
        (["scene", "--camera", "msl-navcm"], ["did you mean 'msl-navcam'?"]),
        (["scene", "--rocks", "-1"], ["--rocks", "found -1"]),
        (["scene", "--rocks", "501"], ["--rocks", "0 to 500", "found 501"]),
        (["scene", "--views", "501"], ["--views", "1 to 500", "found 501"]),
        (["scene", "--scenes", "10000"], ["--scenes", "1 to 9999", "found 10000"]),
        (["scene", "--site", "plain", "--rocks", "60"], ["rocks.count", "at most", "found 60"]),
        (["scene", "--seed", "-1"], ["--seed"]),
        (["scene", "--jobs", "0"], ["--jobs"]),
        (["scene", "--spec", "absent.toml"], ["absent.toml", "TOML"]),
        (["shapes", "--series", "star"], ["--series", "roundness", "'star'"]),
        (["shapes", "--series", "rondness", "--count", "3"], ["did you mean 'roundness'?"]),
        (["shapes", "--series", "roundness", "--count", "0"], ["--count"]),
        (["shapes", "--series", "roundness", "--seed", "-1"], ["--seed"]),
        (["shapes", "--series", "krumbein", "--count", "5"], ["--count", "81"]),
        (["shapes", "--series", "krumbein", "--knobs", "0.5"], ["--knobs", "81"]),
        (["shapes", "--series", "roundness", "--knobs", "a,b"], ["--knobs", "'a,b'"]),
        (["shapes", "--series", "roundness", "--knobs", "0.2,1.5"], ["--knobs", "found 1.5"]),
        (["shapes", "--series", "both", "--jitter", "9"], ["--jitter", "found 9"]),
        (["scene", "--replay", "absent.json"], ["absent.json", "JSON"]),
        (["scene", "--replay", "absent.json", "--rocks", "3"], ["--rocks", "--replay"]),
    ],
)
def test_a_mistake_is_one_line_and_status_2(tmp_path, capsys, options, words):
    kind, *rest = options
    assert main(["synth", kind, str(tmp_path / "out"), *rest]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert all(word in error for word in words)
    assert not (tmp_path / "out").exists()


def test_a_missing_renderer_is_status_3(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(backends, "has_backend", lambda _: False)
    assert main(["synth", "scene", str(tmp_path / "out"), "--renderer", "egl"]) == 3
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "libegl1" in error
    assert not (tmp_path / "out").exists()


def test_shapes_are_written(tmp_path):
    assert main(["synth", "shapes", str(tmp_path / "out"), "--series", "sphericity"]) == 0
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "image.png",
        "image.svg",
        "labels.png",
        "truth.csv",
    }


@pytest.mark.parametrize("kind", [[], ["scene"], ["bed"], ["shapes"]])
def test_help_has_two_examples_that_parse(capsys, kind):
    with pytest.raises(SystemExit) as done:
        main(["synth", *kind, "--help"])
    assert done.value.code == 0
    lines = capsys.readouterr().out.split("examples:\n")[1].splitlines()
    commands = [shlex.split(line) for line in lines if line]
    assert len(commands) == 2
    parser = argparse.ArgumentParser()
    cli.add_arguments(parser)
    for command in commands:
        assert command[:2] == ["rockshape", "synth"]
        parser.parse_args(command[2:])


def test_the_parser_needs_no_heavy_import():
    script = (
        "import argparse, sys\n"
        "from synth import cli\n"
        "cli.add_arguments(argparse.ArgumentParser())\n"
        "print(*{'numpy', 'trimesh', 'cv2', 'scipy', 'pandas', 'skimage'} & set(sys.modules))\n"
    )
    command = [sys.executable, "-c", script]
    found = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (found.returncode, found.stdout.strip()) == (0, "")
