"""Table of pairs, made in several processes: one row a rock, view and noise."""

import dataclasses
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import pandas as pd

from rockshape.uncertainty import Observables
from synth.dataset.workers import worker_pool
from training.uncertainty.pairs import GIVEN, Way, made_pairs


@dataclass(frozen=True)
class PairSet:
    """Scenes to be made: their seed, number and families, or scans in their place.

    `ways` are where the outlines and the range of their rocks come from.
    """

    name: str
    seed: int
    scenes: int
    families: Sequence[str]
    scans: Sequence[str] = ()
    ways: Sequence[Way] = GIVEN


def pair_table(wanted: PairSet, *, jobs: int = 1) -> pd.DataFrame:
    """Rows of a set: `value_…`, `truth_…` and `seen_…` columns beside what the rock is."""
    parts = [range(first, wanted.scenes, jobs) for first in range(jobs)]
    with worker_pool(jobs) as pool:
        rows = [row for found in pool.map(partial(_rows, wanted), parts) for row in found]
    rows.sort(key=lambda row: row["scene"])
    return pd.DataFrame(rows).assign(set=wanted.name)


def observables_of(table: pd.DataFrame) -> list[Observables]:
    """Observables of each row, from its `seen_…` columns."""
    seen = table[[f"seen_{name}" for name in Observables.__dataclass_fields__]]
    return [Observables(*row) for row in seen.itertuples(index=False, name=None)]


def _rows(wanted: PairSet, scenes: Iterable[int]) -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = []
    made = made_pairs(wanted.seed, scenes, wanted.families, scans=wanted.scans, ways=wanted.ways)
    for pair in made:
        row = dataclasses.asdict(pair)
        for kind, name in (("values", "value"), ("truths", "truth"), ("observables", "seen")):
            row |= {f"{name}_{key}": value for key, value in row.pop(kind).items()}
        rows.append(row)
    return rows
