"""Comparison of two runs of one suite: scores that moved by more than their noise."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
import pandas as pd
from scipy import stats

from validation.execution.recorded import Recorded
from validation.scores.score import Better, Definition, score_rng
from validation.scores.scoring import definitions
from validation.statistics.interval import LEVEL, REPLICATES, Weighted, draws_of, in_draws

MARGIN = 0.002  # the difference that another renderer makes
MAX_GROUPS = 20
MIN_GROUPS = 3

Verdict = Literal["worse", "gone", "better", "moved", "same", "new"]
REGRESSIONS = ("worse", "gone")


@dataclass(frozen=True)
class Change:
    """A score in both runs; the interval is that of the difference, paired by rock."""

    name: str
    title: str
    unit: str
    old: float
    new: float
    low: float
    high: float
    verdict: Verdict


def compare(old: Recorded, new: Recorded, *, margin: float = MARGIN) -> tuple[Change, ...]:
    """What became of each score, in the order of the old run, then the new ones.

    A score is worse when the interval of its difference lies on the wrong side of 0 and the
    difference is greater than `margin`, or when it has no value any more. The intervals hold for
    all scores together at 95 % (Bonferroni); the standard error is that of a bootstrap over rocks,
    or of a jackknife over scenes where a score has no weights.
    """
    before = {definition.name: definition for definition in definitions(old.suite)}
    after = {definition.name: definition for definition in definitions(new.suite)}
    changes = [
        _change(
            definition,
            after.get(name),
            old.records,
            new.records,
            scores=len(before),
            margin=margin,
        )
        for name, definition in before.items()
    ]
    changes += [
        _lone(definition, new.records, "new")
        for name, definition in after.items()
        if name not in before
    ]
    return tuple(changes)


def _lone(definition: Definition, records: pd.DataFrame, verdict: Verdict) -> Change:
    value = definition.compute(records).value
    old, new = (value, math.nan) if verdict == "gone" else (math.nan, value)
    nan = math.nan
    return Change(definition.name, definition.title, definition.unit, old, new, nan, nan, verdict)


def _change(
    definition: Definition,
    after: Definition | None,
    old: pd.DataFrame,
    new: pd.DataFrame,
    *,
    scores: int,
    margin: float,
) -> Change:
    if after is None:
        return _lone(definition, old, "gone")
    before, later = definition.compute(old), after.compute(new)
    tail = (1.0 - LEVEL) / 2.0 / scores  # Bonferroni
    if before.weighted is None or later.weighted is None or before.rocks != later.rocks:
        spread, quantile = _jackknife(definition, old, new, tail=tail)
    else:
        spread = _bootstrap(before.weighted, later.weighted, before.rocks, definition.name)
        quantile = float(stats.norm.isf(tail))
    centre, reach = later.value - before.value, quantile * spread
    low, high = centre - reach, centre + reach
    return Change(
        name=definition.name,
        title=definition.title,
        unit=definition.unit,
        old=before.value,
        new=later.value,
        low=low,
        high=high,
        verdict=_verdict(definition.better, before.value, later.value, low, high, margin=margin),
    )


def _verdict(
    better: Better, old: float, new: float, low: float, high: float, *, margin: float
) -> Verdict:
    if math.isnan(old) or math.isnan(new):
        return (
            "same" if math.isnan(old) == math.isnan(new) else "gone" if math.isnan(new) else "new"
        )
    sure = low > 0 or high < 0 or math.isnan(low)
    if not sure or abs(new - old) <= margin:
        return "same"
    if better == "neither":
        return "moved"
    return "better" if (new > old) == (better == "higher") else "worse"


def _bootstrap(before: Weighted, after: Weighted, rocks: int, name: str) -> float:
    """Standard error of after − before by a bootstrap over rocks, the same draws for both."""
    draws = draws_of(rocks, rng=score_rng(name), replicates=REPLICATES)
    found = in_draws(after, draws) - in_draws(before, draws)
    found = found[np.isfinite(found)]
    return float(found.std(ddof=1)) if found.size >= REPLICATES / 2 else math.nan


def _jackknife(
    definition: Definition, old: pd.DataFrame, new: pd.DataFrame, *, tail: float
) -> tuple[float, float]:
    """Standard error of new − old by leaving out groups of scenes in turn, and its quantile of t.

    NaN under three groups.

    Source: Tukey 1958.
    """
    found = np.array([after - before for before, after in _left_out(definition, old, new)])
    found = found[np.isfinite(found)]
    groups = found.size
    if groups < MIN_GROUPS:
        return math.nan, math.nan
    spread = math.sqrt((groups - 1) / groups * float(((found - found.mean()) ** 2).sum()))
    return spread, float(stats.t.isf(tail, groups - 1))


def _left_out(
    definition: Definition, old: pd.DataFrame, new: pd.DataFrame
) -> Iterator[tuple[float, float]]:
    before, after = (
        records[records["experiment"] == definition.key.experiment] for records in (old, new)
    )
    scenes = np.unique(before["scene"].to_numpy(np.int64))
    for group in np.array_split(scenes, min(MAX_GROUPS, scenes.size)):
        yield (
            definition.compute(before[~before["scene"].isin(group)]).value,
            definition.compute(after[~after["scene"].isin(group)]).value,
        )
