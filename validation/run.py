"""Run a suite: its units on local processes, then scores, then gates."""

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context

import cv2
import msgspec
import numpy as np
import pandas as pd

from synth.render import choose_backend
from validation.errors import InputError
from validation.gates import Gate, GateResult, evaluate
from validation.oracle import mixed, oracle, shuffled
from validation.pictures import Picture
from validation.scores import Score, score_records, score_values
from validation.suite import Experiment, Suite, YardExperiment
from validation.units import Unit, UnitResult, run_unit, units_of

SHUFFLE_SEED = 6

OnDone = Callable[[Unit], None]


@dataclass(frozen=True)
class Check:
    """The suite's own gates on records whose verdict is known before."""

    name: str
    fed: str  # what was fed in, in words
    knows: bool  # whether it knows the truth, and must pass every gate, or must not
    gates: tuple[GateResult, ...]

    @property
    def passes(self) -> tuple[str, ...]:
        """The scores whose gates it passed."""
        return tuple(result.gate.score for result in self.gates if result.passed)

    @property
    def sound(self) -> bool:
        """Whether the verdict is the one it must be."""
        return (len(self.passes) == len(self.gates)) == self.knows


@dataclass(frozen=True, eq=False)
class Run:
    """A suite's outcome: what the folder of a run is written from."""

    suite: Suite
    records: pd.DataFrame
    pictures: tuple[Picture, ...]
    backend: str
    scores: tuple[Score, ...]
    gates: tuple[GateResult, ...]
    checks: tuple[Check, ...]  # oracle, shuffled, mixed

    @property
    def passed(self) -> bool:
        """Whether every gate passed."""
        return all(gate.passed for gate in self.gates)


BLAS_THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")


def _one_thread() -> None:
    """Keep a worker to one thread: the processes are the parallelism."""
    cv2.setNumThreads(1)


@contextmanager
def _one_blas_thread() -> Iterator[None]:
    """Let processes begun within start numpy with one thread, unless the user says otherwise."""
    added = {name: "1" for name in BLAS_THREADS if name not in os.environ}
    os.environ.update(added)
    try:
        yield
    finally:
        for name in added:
            del os.environ[name]


def _run_on(executor: Executor, units: Sequence[Unit], on_done: OnDone) -> list[UnitResult]:
    futures = {executor.submit(run_unit, unit): index for index, unit in enumerate(units)}
    try:
        for future in as_completed(futures):
            future.result()
            on_done(units[futures[future]])
    except BaseException:
        executor.shutdown(wait=False, cancel_futures=True)
        raise
    return [future.result() for future in futures]


def run_units(units: Sequence[Unit], *, jobs: int, on_done: OnDone) -> list[UnitResult]:
    """Return the units' results in the units' order, from fresh processes that may render.

    Raises:
        InputError: jobs is less than one.
    """
    if jobs < 1:
        raise InputError(f"--jobs: expected 1 or more, found {jobs}")
    workers = min(jobs, len(units))
    spawn = get_context("spawn")
    with (
        _one_blas_thread(),
        ProcessPoolExecutor(workers, spawn, initializer=_one_thread) as executor,
    ):
        return _run_on(executor, units, on_done)


def default_jobs() -> int:
    """Return the number of processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _with_backend(experiment: Experiment) -> Experiment:
    """Return the experiment with the renderer that this machine has in place of `auto`."""
    if not isinstance(experiment, YardExperiment):
        return experiment
    scene = msgspec.structs.replace(
        experiment.scene, renderer=choose_backend(experiment.scene.renderer)
    )
    return msgspec.structs.replace(experiment, scene=scene)


def assess(suite: Suite, gates: Sequence[Gate], results: Sequence[UnitResult]) -> Run:
    """Score the results and hold the scores, and those of the known measurers, to the gates."""
    rng = np.random.default_rng(SHUFFLE_SEED)
    records = pd.concat([result.records for result in results], ignore_index=True)
    scores = score_records(suite, records)

    def gated(fed: pd.DataFrame) -> tuple[GateResult, ...]:
        return evaluate(gates, score_values(suite, fed))

    return Run(
        suite=suite,
        records=records,
        pictures=tuple(p for result in results for p in result.pictures),
        backend=", ".join(sorted({r.backend for r in results if r.backend})),
        scores=scores,
        gates=evaluate(gates, {score.name: score.value for score in scores}),
        checks=(
            Check("oracle", "the truth as measurement", True, gated(oracle(records))),
            Check("shuffled", "the truth of other rocks", False, gated(shuffled(records, rng=rng))),
            Check("mixed", "the values of other rocks", False, gated(mixed(records, rng=rng))),
        ),
    )


def run_suite(suite: Suite, *, gates: Sequence[Gate], jobs: int, on_done: OnDone) -> Run:
    """Run every unit of the suite and assess what came out.

    Raises:
        MissingBackendError: the machine lacks the renderer; found out before any work is done.
    """
    suite = msgspec.structs.replace(
        suite, experiments=tuple(_with_backend(experiment) for experiment in suite.experiments)
    )
    return assess(suite, gates, run_units(units_of(suite), jobs=jobs, on_done=on_done))
