"""Scores: what a suite's records amount to, each a number, a unit, a count and an interval."""

from collections.abc import Sequence

import pandas as pd

from validation.scores.expectations import Claim
from validation.scores.judge import judge_of
from validation.scores.score import Definition, Key, Score, estimate
from validation.suite.experiment import Experiment
from validation.suite.gates import Gate, ScoreValue
from validation.suite.suite import Suite

__all__ = [
    "Definition",
    "Key",
    "Score",
    "all_claims",
    "all_view_claims",
    "claims_of",
    "definitions",
    "gate_scores",
    "score_names",
    "score_records",
    "score_values",
]


def definitions(suite: Suite) -> tuple[Definition, ...]:
    """All scores of a suite; they are known before anything is measured."""
    return tuple(
        definition
        for experiment in suite.experiments
        for definition in judge_of(experiment).definitions(experiment, suite.measures)
    )


def claims_of(suite: Suite, experiment: Experiment) -> tuple[Claim, ...]:
    """Claims on the rocks of an experiment."""
    return judge_of(experiment).claims(experiment, suite.measures)


def all_claims(suite: Suite) -> tuple[Claim, ...]:
    """Claims on the rocks of all experiments."""
    return tuple(c for experiment in suite.experiments for c in claims_of(suite, experiment))


def all_view_claims(suite: Suite) -> tuple[Claim, ...]:
    """Claims on what views truly show, of all experiments."""
    return tuple(
        claim
        for experiment in suite.experiments
        for claim in judge_of(experiment).view_claims(experiment, suite.measures)
    )


def score_names(suite: Suite) -> frozenset[str]:
    """Names of all scores of a suite."""
    return frozenset(definition.name for definition in definitions(suite))


def score_records(suite: Suite, records: pd.DataFrame) -> tuple[Score, ...]:
    """Score matched records (one row per experiment, scene, view and rock)."""
    return tuple(estimate(definition, records) for definition in definitions(suite))


def score_values(suite: Suite, records: pd.DataFrame) -> dict[str, float]:
    """Values alone, by name, without the cost of the intervals."""
    return {d.name: d.compute(records).value for d in definitions(suite)}


def gate_scores(
    suite: Suite, gates: Sequence[Gate], records: pd.DataFrame
) -> dict[str, ScoreValue]:
    """What the gates ask for: values, and the intervals of those that ask for an end."""
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
