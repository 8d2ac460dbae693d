"""Run a suite: its units on an executor, then scores, then gates."""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import msgspec
import numpy as np
import pandas as pd

from synth.render import choose_backend
from validation.claims import Claim, all_claims, all_view_claims
from validation.dispatch import OnDone, dispatch
from validation.gates import Found, Gate, GateResult, evaluate
from validation.oracle import mixed, oracle, shuffled
from validation.pictures import Album, Picture
from validation.scores import Score, gate_scores, score_records
from validation.scores.yard import VIEW_PREFIX
from validation.store import StoredPicture, StoredResult, UnitStore, unit_key
from validation.suite import Experiment, ShapesExperiment, Suite
from validation.units import UnitResult, units_of

AnyPicture = Picture | StoredPicture
Result = UnitResult | StoredResult

SHUFFLE_SEED = 6


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


def _statistic(gate: Gate) -> str:
    return gate.score.rpartition(".")[2]


def default_jobs() -> int:
    """Return the number of processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _with_backend(experiment: Experiment) -> Experiment:
    """Return the experiment with the renderer that this machine has in place of `auto`."""
    if isinstance(experiment, ShapesExperiment):
        return experiment
    scene = msgspec.structs.replace(
        experiment.scene, renderer=choose_backend(experiment.scene.renderer)
    )
    return msgspec.structs.replace(experiment, scene=scene)


def assess(suite: Suite, gates: Sequence[Gate], results: Iterable[Result]) -> Run:
    """Score the results and hold the scores, and those of the known measurers, to the gates.

    Gates on a level are no part of the checks: the truth is not in the measure's unit.
    """
    rng = np.random.default_rng(SHUFFLE_SEED)
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
    found = {score.name: Found(score.value, score.low, score.high) for score in scores}
    checked = [gate for gate in gates if not gate.score.endswith(".level")]
    of_view = [gate for gate in checked if _statistic(gate).startswith(VIEW_PREFIX)]
    of_rock = [gate for gate in checked if gate not in of_view]

    def gated(feed: Callable[[Sequence[Claim]], pd.DataFrame]) -> tuple[GateResult, ...]:
        return tuple(
            result
            for held, claims in ((of_rock, all_claims(suite)), (of_view, all_view_claims(suite)))
            if held
            for result in evaluate(held, gate_scores(suite, held, feed(claims)))
        )

    return Run(
        suite=suite,
        records=records,
        pictures=tuple(pictures),
        backend=", ".join(sorted(backends - {""})),
        scores=scores,
        gates=evaluate(gates, found),
        checks=(
            Check(
                "oracle",
                "the truth as measurement",
                True,
                gated(lambda claims: oracle(records, claims)),
            ),
            Check(
                "shuffled",
                "the truth of other rocks",
                False,
                gated(lambda claims: shuffled(records, claims, rng=rng)),
            ),
            Check(
                "mixed",
                "the values of other rocks",
                False,
                gated(lambda claims: mixed(records, claims, rng=rng)),
            ),
        )
        if checked
        else (),
        albums=albums,
    )


def prepare(suite: Suite) -> Suite:
    """Return the suite with the renderers that this machine has; its units are then settled.

    Raises:
        MissingBackendError: the machine lacks the renderer; found out before any work is done.
    """
    return msgspec.structs.replace(
        suite, experiments=tuple(_with_backend(experiment) for experiment in suite.experiments)
    )


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
