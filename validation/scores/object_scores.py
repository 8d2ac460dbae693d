"""Scores of found objects: of their counts and values, with weights that a bootstrap draws."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.arrays import Floats
from validation.scores.score import Estimate
from validation.statistics.interval import Weighted
from validation.statistics.weighted import ratio

Compute = Callable[[pd.DataFrame], Estimate]


class Counts(NamedTuple):
    """How many objects of each status there are, (draws,) each."""

    matched: Floats
    missed: Floats
    extra: Floats


def count(status: NDArray[Any], weights: Floats) -> Counts:
    """Counts of statuses (n,) with weights (draws, n)."""
    return Counts(*(weights @ (status == name) for name in Counts._fields))


def f1(counts: Counts) -> Floats:
    """2 TP/(2 TP + FN + FP)."""
    right = 2 * counts.matched
    return ratio(right, right + counts.missed + counts.extra)


def precision(counts: Counts) -> Floats:
    """TP/(TP + FP)."""
    return ratio(counts.matched, counts.matched + counts.extra)


def recall(counts: Counts) -> Floats:
    """TP/(TP + FN)."""
    return ratio(counts.matched, counts.matched + counts.missed)


def f1_of(status: NDArray[Any]) -> float:
    """F1 of objects of these statuses; NaN without any."""
    return float(f1(count(status, np.ones((1, status.size))))[0])


def of_groups(
    of_rows: Weighted,
    shown: pd.DataFrame,
    records: pd.DataFrame,
    groups: Sequence[str],
    *,
    counted: int,
) -> Estimate:
    """Estimate of a statistic of weighted rows, (draws, shown rows), with a weight for each group.

    A group is one combination of values of the columns `groups`. All groups of the records count,
    shown or not, so that two runs of one suite number the same ones alike. Without rows the
    estimate is NaN, and with a single group it has no interval.
    """
    if shown.empty:
        return Estimate(float("nan"), 0)
    names = list(groups)
    every = pd.MultiIndex.from_frame(records[names]).unique().sort_values()
    group = every.get_indexer(pd.MultiIndex.from_frame(shown[names])).astype(np.intp)
    value = float(of_rows(np.ones((1, len(shown))))[0])
    weighted = partial(_of_groups, of_rows, group)
    return Estimate(value, counted, len(every), weighted if len(every) > 1 else None)


def _of_groups(of_rows: Weighted, group: NDArray[np.intp], weights: Floats) -> Floats:
    return of_rows(weights[:, group])


def share_of(value: Callable[[Counts], Floats], groups: Sequence[str]) -> Compute:
    """Statistic of the counts of objects, counted over the true ones."""

    def compute(records: pd.DataFrame) -> Estimate:
        shown = records[records["status"].isin(Counts._fields)]
        status = shown["status"].to_numpy()
        true = int((status != "extra").sum())
        return of_groups(
            lambda weights: value(count(status, weights)), shown, records, groups, counted=true
        )

    return compute


def of_matched(
    column: str, value: Callable[[Floats, Floats], Floats], groups: Sequence[str]
) -> Compute:
    """Statistic of the values (n,) of matched objects in a column, and their weights (draws, n)."""

    def compute(records: pd.DataFrame) -> Estimate:
        shown = records[records["status"] == "matched"]
        values = shown[column].to_numpy(np.float64)
        return of_groups(partial(value, values), shown, records, groups, counted=len(shown))

    return compute


def number_of(column: str) -> Compute:
    """Number of true objects of which a column says so."""

    def compute(records: pd.DataFrame) -> Estimate:
        own = records[records["status"].isin(["matched", "missed"])]
        return Estimate(float(own[column].astype(bool).sum()), len(own))

    return compute


def between(compute: Compute, column: str, low: float, high: float) -> Compute:
    """Score of the objects of which a column lies in [low, high)."""

    def of_some(records: pd.DataFrame) -> Estimate:
        inside = (records[column] >= low) & (records[column] < high)
        return compute(records.assign(status=records["status"].where(inside, "elsewhere")))

    return of_some


def range_name(low: float, high: float) -> str:
    """Name of a range within a score's name: `12_24`, or `48_up` without an end."""
    return f"{low:g}_up" if np.isinf(high) else f"{low:g}_{high:g}"
