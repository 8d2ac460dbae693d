"""A real Dask cluster on this machine: a scheduler and two workers, each a process of its own."""

import sys

import pandas as pd
import pytest

from rockshape.cli import main
from rockshape.execution.executors import cluster, local
from tests.dask_processes import dask_processes
from validation.execution.dispatch import dispatch
from validation.execution.store import UnitStore, unit_key
from validation.execution.units import Unit
from validation.kinds.shapes.spec import ShapesExperiment

pytest.importorskip("distributed", reason="the extra cluster is not installed")

DRAWINGS = ShapesExperiment(name="shapes", title="S", seed=10700, drawings=6)
UNITS = [
    Unit(DRAWINGS, series, scene)
    for series in DRAWINGS.series
    for scene in range(DRAWINGS.drawings)
]
KEYED = [(unit_key(unit), unit) for unit in UNITS]


def _records(store: UnitStore) -> pd.DataFrame:
    return pd.concat(result.records for result in store.results([key for key, _ in KEYED]))


def test_a_worker_killed_in_mid_run_changes_nothing(tmp_path) -> None:
    calm = UnitStore(tmp_path / "calm", keep=False)
    with local(1) as executor:
        dispatch(KEYED, executor, calm, lambda _: None)

    disturbed = UnitStore(tmp_path / "disturbed", keep=False)
    done: list[str] = []
    with dask_processes(tmp_path) as (address, workers), cluster(address) as executor:

        def kill_the_first(unit) -> None:
            done.append(unit)
            if len(done) == 2:
                workers[0].kill()

        dispatch(KEYED, executor, disturbed, kill_the_first)
        assert workers[0].wait(10) != 0
        assert workers[1].poll() is None
    assert len(done) == len(UNITS)
    pd.testing.assert_frame_equal(_records(calm), _records(disturbed), check_exact=True)


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:9", "nonsense://x", "127.0.0.1:notaport"])
def test_no_scheduler_there_is_one_line_and_status_2(
    address, tmp_path, capsys, monkeypatch
) -> None:
    monkeypatch.setattr("rockshape.execution.executors.CONNECT_S", 1)
    out = tmp_path / "out"
    words = [
        "validate",
        "run",
        "--suite",
        "shapes-roundness",
        "--out",
        str(out),
        "--scheduler",
        address,
    ]
    assert main(words) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert address in error
    assert not out.exists()


def test_without_the_package_it_is_one_line_and_status_3(tmp_path, capsys, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    words = ["validate", "run", "--suite", "shapes-roundness", "--out", str(tmp_path / "out")]
    assert main([*words, "--scheduler", "tcp://127.0.0.1:9"]) == 3
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "extra cluster" in error
