"""Mutation bench: views made once, measured anew under each mutation, held to the gates."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from unittest.mock import patch

import msgspec
import pandas as pd

from rockshape.measurement import Measurement, to_frame
from rockshape.method import methods, registered
from rockshape.pipeline import measure
from validation.execution.measured import ViewCase
from validation.execution.units import units_of
from validation.execution.work import views_of
from validation.mutations.mutation import Evaluate, Mutation
from validation.records.join import join
from validation.scores.scoring import claims_of, gate_scores, score_names
from validation.suite.gates import evaluate, gates_on
from validation.suite.suite import Suite


@dataclass(frozen=True)
class Caught:
    """A mutation and the gates that failed under it, by score and bound."""

    mutation: Mutation
    gates: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Bench:
    """A suite's views with the undisturbed measurement of each."""

    suite: Suite
    views: tuple[tuple[ViewCase, Measurement], ...]
    records: pd.DataFrame

    def failing(self, records: pd.DataFrame) -> tuple[str, ...]:
        """Gates that records fail."""
        results = evaluate(self.suite.gates, gate_scores(self.suite, self.suite.gates, records))
        return tuple(
            f"{r.gate.score} {r.gate.relation} {r.gate.bound:g}" for r in results if not r.passed
        )

    def first_scenes(self, experiments: tuple[str, ...]) -> pd.DataFrame:
        """Undisturbed records with the first scene alone of some experiments."""
        later = self.records["experiment"].isin(experiments) & (self.records["scene"] > 0)
        return self.records[~later]

    def catch(self, mutation: Mutation) -> Caught:
        """What the gates say of a mutation."""
        own = self.records["experiment"].isin(mutation.experiments)
        parts = [self.records[~own]]
        for view, found in self.views:
            if view.place.experiment not in mutation.experiments:
                continue
            takes_time = view.observation.points_m is not None
            if takes_time and view.place.scene > 0 and mutation.measures_anew:
                continue
            parts.append(_mutated(view, found, mutation))
        records = pd.concat(parts, ignore_index=True)
        if mutation.records is not None:
            records = mutation.records(records)
        return Caught(mutation, self.failing(records))


def _joined(view: ViewCase, found: Measurement, table: pd.DataFrame) -> pd.DataFrame:
    place = replace(view.place, method=found.method)
    return join(place, view.truth, view.instances, found.labels, table, min_iou=view.min_iou)


@contextmanager
def _measures(method: str, evaluate_by_column: Mapping[str, Evaluate]) -> Iterator[None]:
    """Let the method consist of the mutated measures alone."""
    whole = methods()[method]
    mutated = tuple(
        replace(measure, evaluate=evaluate_by_column[measure.column])
        for measure in whole.measures
        if measure.column in evaluate_by_column
    )
    with registered(replace(whole, measures=mutated)):
        yield


def _mutated(view: ViewCase, found: Measurement, mutation: Mutation) -> pd.DataFrame:
    table = to_frame(found)
    if mutation.evaluate:
        with _measures(found.method, mutation.evaluate):
            again = measure(view.observation, method=found.method, labels=found.labels)
            columns = list(mutation.evaluate)
            table[columns] = to_frame(again)[columns].to_numpy()
    if mutation.finds_anew:
        observe, alter = mutation.observe, mutation.labels
        seen = view.observation if observe is None else observe(view.observation)
        labels = view.given if alter is None else alter(found.labels)
        with ExitStack() as stack:
            if mutation.patch is not None:
                stack.enter_context(patch.object(*mutation.patch))
            found = measure(seen, method=found.method, labels=labels)
        table = to_frame(found)
    if mutation.table is not None:
        table = mutation.table(table)
    return _joined(view, found, table)


def part_of(suite: Suite, *, scenes: int, method: str) -> Suite:
    """Method's part of a suite: its first scenes and the gates on its scores.

    Gates of other methods are left out, and experiments that claim nothing.
    """
    experiments = tuple(
        experiment.first(scenes).measured_by((method,))
        for experiment in suite.experiments
        if claims_of(suite, experiment)
    )
    small = msgspec.structs.replace(suite, experiments=experiments)
    return msgspec.structs.replace(small, gates=gates_on(suite.gates, score_names(small)))


def made_views(suite: Suite, *, scenes: int) -> tuple[ViewCase, ...]:
    """Views of the first scenes of a suite's experiments, for the benches of all methods."""
    experiments = tuple(experiment.first(scenes) for experiment in suite.experiments)
    small = msgspec.structs.replace(suite, experiments=experiments)
    return tuple(view for unit in units_of(small) for view in views_of(unit))


def prepare_bench(
    suite: Suite, *, scenes: int, method: str, views: Sequence[ViewCase] | None = None
) -> Bench:
    """Measure the first scenes of each experiment by one method; they are made unless given."""
    small = part_of(suite, scenes=scenes, method=method)
    names = {experiment.name for experiment in small.experiments}
    measured = tuple(
        (view, measure(view.observation, method=method, labels=view.given))
        for view in (made_views(small, scenes=scenes) if views is None else views)
        if view.place.experiment in names
    )
    records = [_joined(view, found, to_frame(found)) for view, found in measured]
    return Bench(small, measured, pd.concat(records, ignore_index=True))
