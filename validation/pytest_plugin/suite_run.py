"""Runner of a suite in a pytest session: once, whichever process comes to it first."""

import hashlib
from collections.abc import Iterator
from contextlib import nullcontext
from pathlib import Path

import msgspec
import pytest

from synth.errors import MissingBackendError
from validation.api import run_prepared, settled
from validation.errors import InputError, MissingPackageError, WorkerError
from validation.execution.run import Run, prepare
from validation.execution.run_lock import run_lock
from validation.execution.store import UnitStore, unit_key
from validation.execution.units import units_of
from validation.pytest_plugin.gate_outcome import GateOutcome, Outcome, SuiteError
from validation.pytest_plugin.shared import keep_recent, kept_folder, locked, shared_folder
from validation.report import check_target
from validation.scores.scoring import score_names
from validation.suite.gates import GateResult, check_names
from validation.suite.suite import Suite

_EXPECTED = (InputError, MissingBackendError, MissingPackageError, WorkerError)
_ENDING = ".outcome"
_DONE = pytest.StashKey[dict[Path, Outcome]]()


def read_suite(word: str) -> Suite:
    """Suite of a file or a name, its measures tried and its gates' scores checked.

    Raises:
        InputError: a key, a measure or a gate that cannot be used.
    """
    suite = settled(word)
    check_names(suite.gates, score_names(suite), where=word)
    return suite


def outcome_of(suite: Suite, path: Path, config: pytest.Config) -> Outcome:
    """Outcome of a suite, which is run unless a process of this session has done so.

    Raises:
        SuiteError: the suite cannot run, here or where it was tried.
    """
    done = config.stash.setdefault(_DONE, {})
    if path not in done:
        done[path] = _shared_outcome(suite, path, config)
    if done[path].error:
        raise SuiteError(done[path].error)
    return done[path]


def outcomes(config: pytest.Config) -> Iterator[Outcome]:
    """Outcomes of the session so far, of all its processes."""
    for file in sorted(shared_folder(config).glob(f"*{_ENDING}")):
        yield msgspec.msgpack.decode(file.read_bytes(), type=Outcome)


def _shared_outcome(suite: Suite, path: Path, config: pytest.Config) -> Outcome:
    """Read the suite's outcome, or run it and write the outcome for the session's processes."""
    name = hashlib.sha256(str(path).encode()).hexdigest()[:16]
    file = shared_folder(config) / f"{name}{_ENDING}"
    kept = kept_folder(config)
    with locked(kept / "lock"):
        if file.exists():
            return msgspec.msgpack.decode(file.read_bytes(), type=Outcome)
        outcome = Outcome(suite=suite.name, error="expected an outcome, found an unforeseen error")
        try:
            outcome = _run(suite, kept / "units", config)
        except _EXPECTED as error:
            outcome = Outcome(suite=suite.name, error=str(error))
        finally:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(msgspec.msgpack.encode(outcome))
        return outcome


def _run(suite: Suite, folder: Path, config: pytest.Config) -> Outcome:
    report = _report_folder(suite, config)
    suite = prepare(suite)
    store = UnitStore(folder, keep=True)
    keys = [unit_key(unit) for unit in units_of(suite)]
    cached = sum(store.has(key) for key in keys)
    with nullcontext() if report is None else run_lock(report):
        run, seconds = run_prepared(
            suite,
            gates=suite.gates,
            jobs=config.getoption("rockshape_jobs"),
            store=store,
            report=report,
            command=["pytest", *map(str, config.invocation_params.args)],
        )
    keep_recent(folder, [store.path(key) for key in keys], pattern="*/*.parquet")
    return Outcome(
        suite=suite.name,
        gates=tuple(_gate_outcome(run, result) for result in run.gates),
        warnings=tuple(
            f"fed with {check.fed}, the suite "
            + ("does not pass every gate" if check.knows else "passes every gate")
            for check in run.checks
            if not check.sound
        ),
        units=len(keys),
        cached=cached,
        seconds=seconds,
        report="" if report is None else str(report),
    )


def _gate_outcome(run: Run, result: GateResult) -> GateOutcome:
    score = next(score for score in run.scores if score.name == result.gate.score)
    return GateOutcome(gate=result.gate, score=score, passed=result.passed)


def _report_folder(suite: Suite, config: pytest.Config) -> Path | None:
    given = config.getoption("rockshape_report")
    if given is None:
        return None
    out: Path = config.invocation_params.dir / given / suite.name
    check_target(out)
    return out
