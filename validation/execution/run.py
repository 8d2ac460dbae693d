"""Run a suite: its units on an executor, then scores, then gates."""

from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import msgspec
import pandas as pd

from validation.execution.dispatch import OnDone, dispatch
from validation.execution.store import StoredPicture, StoredResult, UnitStore, unit_key
from validation.execution.units import UnitResult, units_of
from validation.records.pictures import Album, Picture
from validation.scores.score import Score
from validation.scores.scoring import score_records
from validation.selfcheck.checks import Check, self_checks
from validation.suite.gates import Gate, GateResult, ScoreValue, evaluate
from validation.suite.suite import Suite

AnyPicture = Picture | StoredPicture
Result = UnitResult | StoredResult


@dataclass(frozen=True, eq=False)
class Run:
    """A suite's outcome: what the folder of a run is written from."""

    suite: Suite
    records: pd.DataFrame
    pictures: tuple[AnyPicture, ...]
    backend: str
    scores: tuple[Score, ...]
    gates: tuple[GateResult, ...]
    checks: tuple[Check, ...]  # oracle, shuffled, mixed
    albums: Mapping[tuple[str, str, int], Album]  # of each experiment, series and scene

    @property
    def passed(self) -> bool:
        """Whether every gate passed."""
        return all(gate.passed for gate in self.gates)


def assess(suite: Suite, gates: Sequence[Gate], results: Iterable[Result]) -> Run:
    """Score the results and hold the scores, and those of the known measurers, to the gates."""
    tables: list[pd.DataFrame] = []
    pictures: list[AnyPicture] = []
    backends: set[str] = set()
    albums: dict[tuple[str, str, int], Album] = {}
    for result in results:
        tables.append(result.records)
        pictures.extend(result.pictures)
        backends.add(result.backend)
        experiment, series, scene = result.records[["experiment", "series", "scene"]].iloc[0]
        albums[str(experiment), str(series), int(scene)] = result.album
    records = pd.concat(tables, ignore_index=True)
    scores = score_records(suite, records)
    found = {score.name: ScoreValue(score.value, score.low, score.high) for score in scores}
    return Run(
        suite=suite,
        records=records,
        pictures=tuple(pictures),
        backend=", ".join(sorted(backends - {""})),
        scores=scores,
        gates=evaluate(gates, found),
        checks=self_checks(suite, gates, records),
        albums=albums,
    )


def prepare(suite: Suite) -> Suite:
    """Suite with the renderers that this machine has; its units are then settled.

    Raises:
        MissingBackendError: the machine lacks the renderer; found out before any work is done.
    """
    experiments = tuple(experiment.settled() for experiment in suite.experiments)
    return msgspec.structs.replace(suite, experiments=experiments)


def run_suite(
    suite: Suite,
    *,
    gates: Sequence[Gate],
    executor: Executor,
    store: UnitStore,
    on_done: OnDone,
) -> Run:
    """Run the units of a prepared suite that the store lacks, then assess all.

    All results are read back from the store, so that a resumed run and an undisturbed one are
    equal.
    """
    keyed = [(unit_key(unit), unit) for unit in units_of(suite)]
    missing = [(key, unit) for key, unit in keyed if not store.has(key)]
    dispatch(missing, executor, store, on_done)
    return assess(suite, gates, store.results([key for key, _ in keyed]))
