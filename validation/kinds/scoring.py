"""Scores: what a suite's records amount to, each a number, a unit, a count and an interval."""

from collections.abc import Sequence

import pandas as pd

from validation.kinds.design import scores as design
from validation.kinds.garden import scores as garden
from validation.kinds.multiview import scores as yard
from validation.kinds.segmentation import scores as segmentation
from validation.kinds.shapes import scores as shapes
from validation.scores.expectations import claims_of, view_claims_of
from validation.scores.score import Definition, Key, Score, estimate
from validation.suite.experiments import (
    DesignExperiment,
    Experiment,
    SegmentationExperiment,
    YardExperiment,
)
from validation.suite.gates import Gate, ScoreValue
from validation.suite.suite import Suite

__all__ = [
    "Definition",
    "Key",
    "Score",
    "definitions",
    "gate_scores",
    "score_names",
    "score_records",
    "score_values",
]


def _of_experiment(suite: Suite, experiment: Experiment) -> Sequence[Definition]:
    if isinstance(experiment, SegmentationExperiment):
        return segmentation.definitions(experiment)
    if isinstance(experiment, DesignExperiment):
        return design.definitions(experiment)
    claims = claims_of(suite, experiment)
    if isinstance(experiment, YardExperiment):
        field = garden.definitions(experiment) if garden.is_garden(experiment) else ()
        return (*yard.definitions(experiment, claims, view_claims_of(suite, experiment)), *field)
    return shapes.definitions(claims)


def definitions(suite: Suite) -> tuple[Definition, ...]:
    """Return all scores of a suite; they are known before anything is measured."""
    return tuple(d for experiment in suite.experiments for d in _of_experiment(suite, experiment))


def score_names(suite: Suite) -> frozenset[str]:
    """Return the names of all scores of a suite."""
    return frozenset(definition.name for definition in definitions(suite))


def score_records(suite: Suite, records: pd.DataFrame) -> tuple[Score, ...]:
    """Score matched records (one row per experiment, scene, view and rock)."""
    return tuple(estimate(definition, records) for definition in definitions(suite))


def score_values(suite: Suite, records: pd.DataFrame) -> dict[str, float]:
    """Return the values alone, by name, without the cost of the intervals."""
    return {d.name: d.compute(records).value for d in definitions(suite)}


def gate_scores(
    suite: Suite, gates: Sequence[Gate], records: pd.DataFrame
) -> dict[str, ScoreValue]:
    """Return what the gates ask for: values, and the intervals of those that ask for an end."""
    wanted = {gate.score: False for gate in gates}
    for gate in gates:
        wanted[gate.score] |= gate.end != "value"
    found = {}
    for definition in definitions(suite):
        if wanted.get(definition.name):
            score = estimate(definition, records)
            found[definition.name] = ScoreValue(score.value, score.low, score.high)
        elif definition.name in wanted:
            found[definition.name] = ScoreValue(definition.compute(records).value)
    return found
