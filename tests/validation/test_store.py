"""Unit results on disk: whole or not there, under a name that says what they depend on."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from concurrent.futures import Future
from multiprocessing import active_children
from pathlib import Path

import msgspec
import pandas as pd
import pytest

from rockshape.execution.executors import LocalExecutor, local
from validation.errors import InputError, WorkerError
from validation.execution import store as store_module
from validation.execution.dispatch import dispatch, run_packed
from validation.execution.store import UnitStore, code_of, is_store, pack, unit_key
from validation.execution.units import Unit, units_of
from validation.execution.work import run_unit
from validation.kinds.shapes.spec import ShapesExperiment
from validation.suite.suite import load_suite

SUITE = """
name = "drawings"
title = "Drawings"

[[experiment]]
kind = "shapes"
name = "shapes"
title = "Shapes"
seed = 10600
drawings = 3

[[gate]]
score = "shapes.sphericity.axis_ratio.tau"
at_least = 0.9
reason = "four shapes far apart"
"""
UNITS = 2 * 3
DRAWINGS = ShapesExperiment(name="shapes", title="S", seed=10600, drawings=3)
UNIT = Unit(DRAWINGS, "sphericity", 0)


@pytest.fixture(scope="module")
def packed() -> bytes:
    """One unit's result as bytes."""
    return run_packed(UNIT)


def test_a_result_comes_back_as_it_was(packed, tmp_path) -> None:
    result = run_unit(UNIT)
    assert pack(result) == packed
    store = UnitStore(tmp_path / "units", keep=False)
    assert not store.has("ab12")
    store.put("ab12", packed)
    assert store.has("ab12")
    back = store.get("ab12")
    pd.testing.assert_frame_equal(
        back.records, result.records.astype({"flags": "str", "reason": "str"}), check_exact=True
    )
    (picture,), (original,) = back.pictures, result.pictures
    assert (picture.jpeg, picture.place) == (original.jpeg, original.place)
    assert picture.size_bytes == len(original.jpeg)
    assert [path.suffix for path in tmp_path.rglob("ab12*")] == [".parquet"]


def test_the_key_tells_what_matters_and_nothing_else(monkeypatch) -> None:
    def key(**changes) -> str:
        experiment = msgspec.structs.replace(DRAWINGS, **changes)
        return unit_key(Unit(experiment, "sphericity", 1))

    assert key() == key(title="another", drawings=99)
    others = {key(seed=1), key(count=5), key(name="other"), unit_key(UNIT)}
    others.add(unit_key(Unit(DRAWINGS, "roundness", 1)))
    assert len(others | {key()}) == 6
    before = key()
    monkeypatch.setattr(store_module, "code_digest", lambda: "other code")
    assert key() != before


def test_half_a_file_is_no_result_and_is_cleared_away(packed, tmp_path) -> None:
    store = UnitStore(tmp_path, keep=False)
    store.path("cd34").parent.mkdir()
    store.path("cd34").write_bytes(packed[:1000])
    assert not store.has("cd34")
    half = store.path("cd34").with_suffix(".7.partial")
    half.write_bytes(b"half")
    store.put("ab12", packed)
    assert UnitStore(tmp_path, keep=True).has("ab12")
    assert not half.exists()
    assert not UnitStore(tmp_path, keep=False).has("ab12")


def test_another_folder_is_left_alone(tmp_path) -> None:
    (tmp_path / "thesis.txt").write_text("mine", encoding="utf-8")
    with pytest.raises(InputError, match="unit results"):
        UnitStore(tmp_path, keep=False)
    assert (tmp_path / "thesis.txt").exists()
    assert not is_store(tmp_path)


def test_a_killed_process_costs_only_its_call() -> None:
    with local(2) as executor:
        one, two = executor.submit(time.sleep, 1.5), executor.submit(time.sleep, 1.5)
        deadline = time.monotonic() + 30
        while len(active_children()) < 2 and time.monotonic() < deadline:
            time.sleep(0.02)
        time.sleep(0.5)
        os.kill(active_children()[0].pid, signal.SIGKILL)
        assert (one.result(60), two.result(60)) == (None, None)


def test_a_unit_that_kills_every_process_ends_the_run() -> None:
    with LocalExecutor(1) as executor, pytest.raises(WorkerError, match="3 processes died"):
        executor.submit(os._exit, 1).result(120)


def test_a_worker_with_other_code_is_refused(packed, tmp_path, monkeypatch) -> None:
    class Elsewhere(LocalExecutor):
        def submit(self, fn, /, *args, **kwargs):  # noqa: ARG002
            future: Future[bytes] = Future()
            future.set_result(packed)
            return future

    monkeypatch.setattr("validation.execution.dispatch.code_digest", lambda: "ours")
    assert code_of(packed) != "ours"
    with Elsewhere(1) as executor, pytest.raises(WorkerError, match="code"):
        dispatch([("ab", UNIT)], executor, UnitStore(tmp_path, keep=False), lambda _: None)


def test_a_run_goes_on_when_a_worker_is_killed(tmp_path) -> None:
    path = tmp_path / "drawings.toml"
    path.write_text(SUITE, encoding="utf-8")
    suite = load_suite(str(path))
    units = units_of(suite)
    keys = [unit_key(unit) for unit in units]
    killed: list[int] = []

    def kill_one(_) -> None:
        if not killed:
            killed.append(active_children()[0].pid)
            os.kill(killed[0], signal.SIGKILL)

    tables = []
    for name, on_done in (("calm", lambda _: None), ("disturbed", kill_one)):
        store = UnitStore(tmp_path / name, keep=False)
        with local(2) as executor:
            dispatch(list(zip(keys, units, strict=True)), executor, store, on_done)
        tables.append(pd.concat(result.records for result in store.results(keys)))
    assert killed
    pd.testing.assert_frame_equal(*tables, check_exact=True)


def _start(out: Path, suite: Path, *more: str) -> "subprocess.Popen[bytes]":
    command = [sys.executable, "-m", "rockshape.cli", "validate", "run", "--suite", str(suite)]
    return subprocess.Popen(
        [*command, "--out", str(out), "--jobs", "1", *more],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
    )


def test_killed_and_resumed_gives_the_same_bytes(tmp_path) -> None:
    suite = tmp_path / "drawings.toml"
    suite.write_text(SUITE, encoding="utf-8")
    calm, killed = tmp_path / "calm", tmp_path / "killed"
    with _start(calm, suite) as undisturbed:
        assert undisturbed.wait(240) == 0

    with _start(killed, suite) as first:
        deadline = time.monotonic() + 120
        while not list(killed.rglob("*.parquet")) and time.monotonic() < deadline:
            time.sleep(0.005)
        first.send_signal(signal.SIGKILL)
        first.communicate(timeout=60)  # the pipe ends when the workers too have gone
        assert first.returncode == -signal.SIGKILL
    done = len(list((killed / "units").rglob("*.parquet")))
    assert 1 <= done < UNITS
    assert not (killed / "scores.json").exists()

    with _start(killed, suite, "--resume") as second:
        _, said = second.communicate(timeout=240)
        assert second.returncode == 0
    assert f"{done} of {UNITS} units are there already" in said.decode()
    assert (killed / "scores.json").read_bytes() == (calm / "scores.json").read_bytes()
    for name in ("results.parquet", "summary.md"):
        assert (killed / name).read_bytes() == (calm / name).read_bytes()
    junit = [
        re.sub(r' time="[^"]*"', "", (run / "junit.xml").read_text(encoding="utf-8"))
        for run in (killed, calm)
    ]
    assert junit[0] == junit[1]
    assert json.loads((killed / "scores.json").read_text(encoding="utf-8"))["passed"]
