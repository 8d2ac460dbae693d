"""The rank table: the rocks of one scene by their true order, and their rank in each view."""

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy import stats

from validation.scores.expectations import Claim


@dataclass(frozen=True)
class RankCell:
    """A rock's rank in one view and by how many ranks it is wrong; None where unmeasured."""

    rock: int | None  # the rock's number in that view's picture
    rank: float | None
    value: float
    off: int | None


@dataclass(frozen=True)
class RankRow:
    """A rock: its true rank (1 the greatest), its truth, and a cell for each view."""

    instance: int
    true_rank: float
    truth: float
    cells: tuple[RankCell, ...]


@dataclass(frozen=True)
class RankTable:
    """The ranks of one measure in one scene."""

    claim: Claim
    views: tuple[int, ...]
    rows: tuple[RankRow, ...]


def _ranks(values: NDArray[np.float64]) -> list[float]:
    """Ranks from 1 for the greatest; NaN stays NaN."""
    ranks: list[float] = stats.rankdata(-values, nan_policy="omit").tolist()
    return ranks


def rank_table(scene: pd.DataFrame, claim: Claim) -> RankTable:
    """Ranks of a measure in one scene's records.

    In a view, the true ranks are taken among the rocks measured there, so that a missing rock does
    not shift the others.
    """
    rocks = scene[(scene["status"] != "extra") & (scene["method"] == claim.method)]
    truth = rocks.drop_duplicates("instance").set_index("instance")[claim.truth].dropna()
    truth = truth.sort_values(ascending=False, kind="stable")
    true_values = truth.to_numpy(dtype=np.float64)
    columns: dict[int, list[RankCell]] = {}
    for view, shown in rocks.groupby("view", sort=True):
        usable = shown[shown["eligible"].astype(bool)].set_index("instance").reindex(truth.index)
        values = usable[claim.measure].to_numpy(dtype=np.float64)
        numbers = usable["rock"].astype(np.float64).fillna(0).to_numpy(dtype=np.int64)
        found = _ranks(values)
        expected = _ranks(np.where(np.isfinite(values), true_values, np.nan))
        columns[int(str(view))] = [
            RankCell(
                rock=int(number) or None,
                rank=rank if np.isfinite(rank) else None,
                value=float(value),
                off=int(abs(rank - right)) if np.isfinite(rank) else None,
            )
            for number, rank, right, value in zip(numbers, found, expected, values, strict=True)
        ]
    true_ranks = _ranks(true_values)
    rows = tuple(
        RankRow(
            instance=int(str(instance)),
            true_rank=true_ranks[i],
            truth=float(true_values[i]),
            cells=tuple(column[i] for column in columns.values()),
        )
        for i, instance in enumerate(truth.index)
    )
    return RankTable(claim=claim, views=tuple(columns), rows=rows)
