"""Scores: what a suite's records amount to, each a number, a unit, a count and an interval."""

from collections.abc import Sequence

import pandas as pd

from validation.scores import shapes, yard
from validation.scores.score import Definition, Score, estimate
from validation.suite import Experiment, Suite, YardExperiment

__all__ = ["Definition", "Score", "definitions", "score_records", "score_values"]


def _of_experiment(experiment: Experiment) -> Sequence[Definition]:
    if isinstance(experiment, YardExperiment):
        return yard.definitions(experiment)
    return shapes.definitions(experiment)


def definitions(suite: Suite) -> tuple[Definition, ...]:
    """Return all scores of a suite; they are known before anything is measured."""
    return tuple(d for experiment in suite.experiments for d in _of_experiment(experiment))


def score_records(suite: Suite, records: pd.DataFrame) -> tuple[Score, ...]:
    """Score matched records (one row per experiment, scene, view and rock)."""
    return tuple(estimate(definition, records) for definition in definitions(suite))


def score_values(suite: Suite, records: pd.DataFrame) -> dict[str, float]:
    """Return the values alone, by name, without the cost of the intervals."""
    return {d.name: d.compute(records).value for d in definitions(suite)}
