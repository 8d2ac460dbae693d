"""Scores of values that no suite has, by the statistics and the intervals of the suites."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Self

import numpy as np
import pandas as pd
from case import Cell, Column

from validation.kinds.multiview.judge.levels import DIFFERENCES
from validation.kinds.pebbles import judge as pebbles
from validation.scores.agreement import STATISTICS
from validation.scores.score import Definition, Estimate, Key, estimate
from validation.statistics import Block

KNOWN = {one.key: one for one in (*pebbles.STATISTICS, *DIFFERENCES, *STATISTICS)}


@dataclass(frozen=True)
class Scored:
    """A score with its 95 % interval, NaN where it has none."""

    value: float
    low: float
    high: float
    count: int

    @classmethod
    def of(cls, score: pd.Series) -> Self:
        """Score of a row of a suite's table."""
        value, low, high = (float(score[key]) for key in ("value", "low", "high"))
        return cls(value, low, high, int(score["count"]))

    @property
    def interval(self) -> str:
        """The interval as tables have it."""
        found = np.isfinite([self.low, self.high]).all()
        return f"{self.low:.3f} … {self.high:.3f}" if found else "–"

    def cells(self) -> tuple[Cell, ...]:
        """Value, interval and count."""
        return self.value, self.interval, self.count


def score_columns(words: Iterable[str]) -> list[Column]:
    """Columns of statistics, each with its interval."""
    return [column for one in words for column in (Column(one, "", ".3f"), Column("95 %"))]


def score_cells(scores: Iterable[Scored | None]) -> list[Cell]:
    """Cells of those columns; empty where there is no score."""
    return [cell for one in scores for cell in (one.cells()[:2] if one else (None, "–"))]


def scored(statistic: str, blocks: Sequence[Block], *, name: str) -> Scored:
    """Statistic of blocks of values; the bootstrap's draws depend on the name, as in a suite."""
    one = KNOWN[statistic]
    compute = partial(_computed, one.compute(blocks))
    key = Key(name, "", "", "", statistic)
    definition = Definition(key, one.title, one.unit, one.counted, one.better, compute)
    score = estimate(definition, pd.DataFrame())
    return Scored(score.value, score.low, score.high, score.count)


def _computed(found: Estimate, records: pd.DataFrame) -> Estimate:  # noqa: ARG001
    return found
