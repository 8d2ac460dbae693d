"""The same bytes again: after SIGKILL half way, and from the manifest."""

import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys
import time

import pytest

from rockshape.cli import main
from synth.dataset.generate import generate_dataset
from synth.dataset.layout import PARTIAL
from synth.spec import load_spec
from tests.digests import digests

SPEC = """
site = "plain"
seed = 21
scenes = 3
[rocks]
count = 2
family = "rounded-box"
[camera]
preset = "imp"
[views]
count = 1
[noise]
kind = "sgm"
[sensor]
full_well_e = 20000
read_noise_e = 25
jpeg_quality = 90
"""
_PATIENCE_SECONDS = 60


@pytest.fixture(scope="module")
def spec_path(tmp_path_factory):
    path = tmp_path_factory.mktemp("spec") / "spec.toml"
    path.write_text(SPEC)
    return path


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory, spec_path):
    out = tmp_path_factory.mktemp("undisturbed") / "dataset"
    generate_dataset(load_spec(spec_path), out)
    return out


def test_a_run_killed_half_way_goes_on_to_the_same_bytes(undisturbed, spec_path, tmp_path):
    out = tmp_path / "killed"
    command = [sys.executable, "-m", "rockshape.cli", "synth", "scene", str(out)]
    process = subprocess.Popen(
        [*command, "--spec", str(spec_path)],
        stderr=subprocess.DEVNULL,
        start_new_session=True,  # so that its workers die with it
    )
    deadline = time.monotonic() + _PATIENCE_SECONDS
    while not (out / "000000").is_dir():
        assert process.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.005)
    os.killpg(process.pid, signal.SIGKILL)
    assert process.wait() == -signal.SIGKILL
    assert not (out / "manifest.json").exists()
    assert not (out / "000002").exists()
    assert (out / PARTIAL / "identity.json").is_file()
    kept = (out / "000000" / "scene_gt.json").stat().st_mtime_ns
    generate_dataset(load_spec(spec_path), out)
    assert digests(out) == digests(undisturbed)
    assert (out / "000000" / "scene_gt.json").stat().st_mtime_ns == kept


def test_a_run_killed_before_its_manifest_goes_on(undisturbed, spec_path, tmp_path):
    out = tmp_path / "late"
    shutil.copytree(undisturbed, out)
    manifest = json.loads((out / "manifest.json").read_text())
    (out / "manifest.json").unlink()
    (out / "manifest.draft").write_text('{"spec": ')
    (out / PARTIAL).mkdir()
    del manifest["files"]
    (out / PARTIAL / "identity.json").write_text(json.dumps(manifest))
    generate_dataset(load_spec(spec_path), out)
    assert digests(out) == digests(undisturbed)


def test_replay_makes_the_same_bytes_and_says_so(undisturbed, tmp_path, capsys):
    out = tmp_path / "again"
    manifest = undisturbed / "manifest.json"
    assert main(["synth", "scene", "--replay", str(manifest), str(out)]) == 0
    files = json.loads(manifest.read_text())["files"]
    said = capsys.readouterr().out
    assert f"{len(files)} files" in said
    assert "SHA-256" in said
    assert digests(out) == digests(undisturbed)


def test_replay_names_the_first_file_that_differs(undisturbed, tmp_path, capsys):
    out = tmp_path / "again"
    shutil.copytree(undisturbed, out)
    for name in ("000002/gray/000000.png", "000001/labels/000000.png"):
        (out / name).write_bytes(b"spoilt")
    assert main(["synth", "scene", "--replay", str(undisturbed / "manifest.json"), str(out)]) == 1
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "000001/labels/000000.png: expected SHA-256" in error
    assert hashlib.sha256(b"spoilt").hexdigest() in error


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda m: m.pop("files"), ["'files'"]),
        (lambda m: m.update(backend="foo"), ["backend", "'foo'"]),
        (lambda m: m["spec"].update(sead=3), ["spec", "sead"]),
        (lambda m: m.update(files=3), ["files", "int"]),
    ],
)
def test_a_manifest_that_is_none_is_refused(undisturbed, tmp_path, capsys, change, words):
    manifest = json.loads((undisturbed / "manifest.json").read_text())
    change(manifest)
    path = tmp_path / "manifest.json"
    path.write_text(json.dumps(manifest))
    assert main(["synth", "scene", "--replay", str(path), str(tmp_path / "out")]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert all(word in error for word in words)
    assert not (tmp_path / "out").exists()
