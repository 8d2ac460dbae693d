"""Run folder read back: its suite, records and gates, also of older runs."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from validation.errors import InputError
from validation.scores.scoring import all_claims
from validation.suite.registry import kind_of
from validation.suite.suite import Suite, as_suite

FORMAT = "rockshape validation run 2"
_ROCK = ["experiment", "series", "scene", "seed", "instance"]
_TRUTH_TOLERANCE = 1e-6  # relative: truth goes through JSON and CSV, nothing else


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
    spec = document.get("spec")
    if not isinstance(spec, dict):
        raise InputError(f"{folder}: scores.json: expected the suite as spec, found {spec!r}")
    suite = as_suite(spec, where=f"{folder}: scores.json: spec")
    gates = {_gate_name(gate): bool(gate["passed"]) for gate in document.get("gates", ())}
    names = {each.name: kind_of(each).name for each in suite.experiments}
    records = records.assign(kind=records["experiment"].map(names))
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
    """Rocks of some experiments with the truths that claims are held by."""
    rows = run.records[run.records["status"].isin(["matched", "missed"])]
    rows = rows[rows["experiment"].isin(sorted(experiments))]
    truths = sorted({claim.truth for claim in all_claims(run.suite)} & set(rows.columns))
    return rows.drop_duplicates(_ROCK).set_index(_ROCK)[truths].sort_index().astype(np.float64)


def failed_gates(old: Recorded, new: Recorded) -> tuple[str, ...]:
    """Gates that the old run passed and the new one fails."""
    return tuple(name for name, passed in new.gates.items() if not passed and old.gates.get(name))
