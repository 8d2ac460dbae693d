"""Two runs of one suite side by side: what moved, and what got worse by more than its noise."""

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import msgspec
import numpy as np
import pandas as pd
from scipy import stats

from validation.errors import InputError
from validation.kinds.scoring import definitions
from validation.report.scores_json import FORMAT
from validation.scores.expectations import all_claims
from validation.scores.score import Better, Definition, score_rng
from validation.statistics.interval import LEVEL, REPLICATES
from validation.suite.suite import Suite

MARGIN = 0.002  # the difference that another renderer makes
MAX_GROUPS = 20
MIN_GROUPS = 3
_ROCK = ["experiment", "series", "scene", "seed", "instance"]
_TRUTH_TOLERANCE = 1e-6  # relative: truth goes through JSON and CSV, nothing else

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


@dataclass(frozen=True, eq=False)
class Recorded:
    """A run as its folder tells it."""

    folder: Path
    suite: Suite
    records: pd.DataFrame
    gates: dict[str, bool]  # by score and bound: whether it passed


def load_recorded(folder: Path) -> Recorded:
    """Read a run's scores.json and results.parquet.

    Raises:
        InputError: the folder is no run, or one of another version.
    """
    try:
        document: Any = json.loads((folder / "scores.json").read_text(encoding="utf-8"))
        records = pd.read_parquet(folder / "results.parquet")
    except (OSError, ValueError) as error:
        raise InputError(
            f"{folder}: expected a run with scores.json and results.parquet, found: {error}"
        ) from error
    found = document.get("format") if isinstance(document, dict) else None
    if found != FORMAT:
        raise InputError(f"{folder}: expected the format {FORMAT!r}, found {found!r}")
    try:
        suite = msgspec.convert(document["spec"], Suite)
    except (KeyError, msgspec.ValidationError) as error:
        raise InputError(f"{folder}: scores.json: spec: {error}") from error
    gates = {_gate_name(gate): bool(gate["passed"]) for gate in document.get("gates", ())}
    return Recorded(folder=folder, suite=suite, records=records, gates=gates)


def _gate_name(gate: dict[str, Any]) -> str:
    relation, bound = ("≥", gate["at_least"]) if gate["at_most"] is None else ("≤", gate["at_most"])
    return f"{gate['score']} {relation} {bound}"


def check_paired(old: Recorded, new: Recorded) -> None:
    """Refuse runs that do not show the same rocks.

    Raises:
        InputError: no experiment in common, other rocks, or rocks of another truth.
    """
    common = {e.name for e in old.suite.experiments} & {e.name for e in new.suite.experiments}
    if not common:
        raise InputError(f"{new.folder}: expected an experiment of {old.folder}, found none")
    before, after = (_rocks(run, common) for run in (old, new))
    if not before.index.equals(after.index):
        raise InputError(
            f"{new.folder}: expected the {len(before)} rocks of {old.folder}, found "
            f"{len(before.index.intersection(after.index))} of them and "
            f"{len(after.index.difference(before.index))} others"
        )
    for column in before.columns.intersection(after.columns):
        one, other = before[column].to_numpy(), after[column].to_numpy()
        if not np.allclose(one, other, rtol=_TRUTH_TOLERANCE, atol=0, equal_nan=True):
            raise InputError(
                f"{new.folder}: expected the truth of {old.folder}, found another {column}"
            )


def _rocks(run: Recorded, experiments: set[str]) -> pd.DataFrame:
    """Return the rocks of some experiments with the truths that claims are held by."""
    rows = run.records[run.records["status"].isin(["matched", "missed"])]
    rows = rows[rows["experiment"].isin(sorted(experiments))]
    truths = sorted({claim.truth for claim in all_claims(run.suite)} & set(rows.columns))
    return rows.drop_duplicates(_ROCK).set_index(_ROCK)[truths].sort_index().astype(np.float64)


def compare(old: Recorded, new: Recorded, *, margin: float = MARGIN) -> tuple[Change, ...]:
    """Return what became of each score, in the order of the old run, then the new ones.

    A score is worse when the interval of its difference lies on the wrong side of 0 and the
    difference is greater than `margin`, or when it has no value any more.
    """
    before = {definition.name: definition for definition in definitions(old.suite)}
    after = {definition.name: definition for definition in definitions(new.suite)}
    changes = [
        _change(
            definition, after.get(name), old.records, new.records, scores=len(before), margin=margin
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
    before_value, after_value = definition.compute(old).value, after.compute(new).value
    low, high = _interval(definition, old, new, scores=scores)
    return Change(
        name=definition.name,
        title=definition.title,
        unit=definition.unit,
        old=before_value,
        new=after_value,
        low=low,
        high=high,
        verdict=_verdict(definition.better, before_value, after_value, low, high, margin=margin),
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


def _interval(
    definition: Definition, old: pd.DataFrame, new: pd.DataFrame, *, scores: int
) -> tuple[float, float]:
    """Return the interval of new − old that holds for all scores together at 95 % (Bonferroni).

    The standard error is that of a bootstrap over rocks, the same draws for both runs; where a
    score has no weights, that of leaving out groups of scenes in turn (Tukey 1958), NaN under
    three.
    """
    before, after = definition.compute(old), definition.compute(new)
    tail = (1.0 - LEVEL) / 2.0 / scores
    if before.weighted is None or after.weighted is None or before.rocks != after.rocks:
        spread, quantile = _jackknife(definition, old, new, tail=tail)
    else:
        draws = score_rng(definition.name).multinomial(
            before.rocks, np.full(before.rocks, 1.0 / before.rocks), size=REPLICATES
        )
        weights = draws.astype(np.float64)
        found = np.array([after.weighted(w) - before.weighted(w) for w in weights])
        found = found[np.isfinite(found)]
        spread = float(found.std(ddof=1)) if found.size >= REPLICATES / 2 else math.nan
        quantile = float(stats.norm.isf(tail))
    centre, reach = after.value - before.value, quantile * spread
    return centre - reach, centre + reach


def _jackknife(
    definition: Definition, old: pd.DataFrame, new: pd.DataFrame, *, tail: float
) -> tuple[float, float]:
    """Return the standard error of new − old by leaving out scenes, and its quantile of t."""
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


def failed_gates(old: Recorded, new: Recorded) -> tuple[str, ...]:
    """Return the gates that the old run passed and the new one fails."""
    return tuple(name for name, passed in new.gates.items() if not passed and old.gates.get(name))
