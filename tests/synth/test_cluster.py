"""Scenes made by a Dask cluster's workers: the same bytes as without."""

from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import entry_points
from pathlib import Path

import pytest

from rockshape.cli import main
from synth.dataset.common import file_digests
from synth.dataset.generate import generate_dataset
from synth.errors import SpecError
from synth.handle.remote import RemoteExecutor
from synth.spec import convert_spec
from tests.dask_processes import dask_processes

SMALL = ("--site", "plain", "--scenes", "2", "--rocks", "2", "--views", "1", "--seed", "3")
SCENE = ("synth", "scene")


def words(out: Path, *more: str) -> list[str]:
    return [*SCENE, str(out), *SMALL, *more]


def test_a_cluster_makes_the_same_bytes(tmp_path: Path) -> None:
    pytest.importorskip("distributed", reason="the extra cluster is not installed")
    here, there, again = (tmp_path / name for name in ("here", "there", "again"))
    assert main(words(here)) == 0
    with dask_processes(tmp_path / "dask") as (address, _):
        assert main(words(there, "--scheduler", address)) == 0
        manifest = ("--replay", str(here / "manifest.json"))
        assert main([*SCENE, str(again), *manifest, "--scheduler", address]) == 0
    assert len(file_digests(here)) > 10
    assert file_digests(there) == file_digests(here)
    assert (there / "manifest.json").read_bytes() == (here / "manifest.json").read_bytes()


def test_workers_that_write_elsewhere_are_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("synth.handle.remote.answer", lambda _: "000000")  # it wrote nothing here
    spec = convert_spec({"scenes": 1}, where="spec")
    with ThreadPoolExecutor(1) as threads, pytest.raises(SpecError, match="all workers write to"):
        generate_dataset(spec, tmp_path / "out", executor=RemoteExecutor(threads))
    assert not (tmp_path / "out").exists()


def test_no_scheduler_there_is_one_line_and_status_2(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed", reason="the extra cluster is not installed")
    monkeypatch.setattr("rockshape.execution.executors.CONNECT_S", 1)
    assert main(words(tmp_path / "out", "--scheduler", "tcp://127.0.0.1:9")) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_the_cluster_is_the_one_that_batches_and_validation_use() -> None:
    (entry,) = entry_points(group="synth.executors", name="cluster")
    assert entry.value == "rockshape.execution.executors:cluster"
