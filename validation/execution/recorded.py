"""Run folder read back: its suite, records and gates, also of older runs."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
from msgspec import Struct

from synth.text_file import read_text
from validation.errors import InputError
from validation.records.join import RecordKey
from validation.scores.scoring import all_claims
from validation.suite.decode import decode
from validation.suite.registry import kind_of
from validation.suite.suite import Suite, as_suite

FORMAT = "rockshape validation run 2"
MAX_CELLS = 10**8  # of the records
_EXPECTED = "expected a run with scores.json and results.parquet"
_OF_A_ROW = ("instance", "rock", "status", "eligible")
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
    document = _document(folder)
    records = _records(folder)
    found = document.get("format") if isinstance(document, dict) else None
    if found != FORMAT:
        raise InputError(f"{folder}: expected the format {FORMAT!r}, found {found!r}")
    where = f"{folder}: scores.json"
    spec = document.get("spec")
    if not isinstance(spec, dict):
        raise InputError(f"{where}: expected the suite as spec, found {type(spec).__name__}")
    suite = as_suite(spec, where=f"{where}: spec")
    results = decode(document.get("gates", []), list[_GateResult], where=where, path="gates")
    _check_columns(folder, records, suite)
    names = {each.name: kind_of(each).name for each in suite.experiments}
    return Recorded(
        folder=folder,
        suite=suite,
        records=records.assign(kind=records["experiment"].map(names)),
        gates={gate.name: gate.passed for gate in results},
    )


class _GateResult(Struct):
    """Gate of scores.json; its other keys do not matter here."""

    score: str
    at_least: float | None
    at_most: float | None
    passed: bool

    @property
    def name(self) -> str:
        if self.at_most is None:
            return f"{self.score} ≥ {self.at_least}"
        return f"{self.score} ≤ {self.at_most}"


def _document(folder: Path) -> Any:
    try:
        return json.loads(read_text(folder / "scores.json"))
    except FileNotFoundError as error:
        raise InputError(f"{folder}: {_EXPECTED}, found no scores.json") from error
    except (OSError, ValueError, RecursionError) as error:
        raise InputError(f"{folder}: {_EXPECTED}, found: {error}") from error


def _records(folder: Path) -> pd.DataFrame:
    file = (folder / "results.parquet").absolute()  # pyarrow takes a relative `a:b` for a URI
    try:
        head = pq.read_metadata(file)
        cells = head.num_rows * head.num_columns
        records = pd.read_parquet(file) if cells <= MAX_CELLS else None
    except Exception as error:  # of the libraries, for damaged files, any
        raise InputError(f"{folder}: {_EXPECTED}, found: {error}") from error
    if records is None:
        raise InputError(f"{file}: expected at most {MAX_CELLS} values, found {cells}")
    return records


def _check_columns(folder: Path, records: pd.DataFrame, suite: Suite) -> None:
    """Refuse records without the columns that every run has and those that the suite judges."""
    claims = all_claims(suite)
    places = [name for name in RecordKey.__dataclass_fields__ if name != "kind"]
    needed = [
        *places,
        *_OF_A_ROW,
        *(claim.truth for claim in claims),
        *(claim.measure for claim in claims),
    ]
    missing = next((name for name in needed if name not in records), None)
    if missing is not None:
        raise InputError(f"{folder}: results.parquet: expected the column {missing}, found none")
    for name in ("scene", "seed", "view", *(claim.measure for claim in claims)):
        kind = records[name].dtype
        if not pd.api.types.is_numeric_dtype(kind):
            raise InputError(f"{folder}: results.parquet: {name}: expected numbers, found {kind}")
    if records.duplicated([*places, "instance", "rock"]).any():
        raise InputError(f"{folder}: results.parquet: expected each rock once, found some again")


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
