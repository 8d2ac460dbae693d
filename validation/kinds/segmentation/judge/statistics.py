"""Statistics of the objects in views: F1, precision, recall, masks, pieces and the ground."""

from collections.abc import Callable
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
_Pooled = Callable[[Floats, Floats], Floats]  # of values (n,) and their weights (draws, n)


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


def of_matched(column: str, value: _Pooled) -> Compute:
    """Statistic of the matched rocks' values in a column."""

    def compute(records: pd.DataFrame) -> Estimate:
        shown = records[records["status"] == "matched"]
        values = shown[column].to_numpy(np.float64)
        return _by_scene(partial(value, values), shown, records, counted=len(shown))

    return compute


def share_of(value: Callable[[Counts], Floats]) -> Compute:
    """Statistic of the counts of objects."""

    def compute(records: pd.DataFrame) -> Estimate:
        shown = records[records["status"].isin(Counts._fields)]
        status = shown["status"].to_numpy()
        own = int((status != "extra").sum())
        return _by_scene(lambda weights: value(count(status, weights)), shown, records, counted=own)

    return compute


def number_of(column: str) -> Compute:
    """Number of true rocks of which a column says so."""

    def compute(records: pd.DataFrame) -> Estimate:
        own = records[records["status"].isin(["matched", "missed"])]
        return Estimate(float(own[column].astype(bool).sum()), len(own))

    return compute


def ground_error(records: pd.DataFrame) -> Estimate:
    """Median over views of the ground's RMS error in the range's noise."""
    views = records.drop_duplicates(["scene", "view"])["ground_sigmas"].dropna()
    value = float(views.median()) if len(views) else float("nan")
    return Estimate(value, len(views))


def f1_between(column: str, low: float, high: float) -> Compute:
    """F1 of the objects of which a column lies in [low, high)."""
    whole = share_of(f1)

    def compute(records: pd.DataFrame) -> Estimate:
        inside = (records[column] >= low) & (records[column] < high)
        return whole(records.assign(status=records["status"].where(inside, "elsewhere")))

    return compute


def _by_scene(
    of_rows: Weighted, shown: pd.DataFrame, records: pd.DataFrame, *, counted: int
) -> Estimate:
    """Estimate of a statistic of weighted rows, (draws, shown rows), with a weight a scene.

    All scenes count, shown or not, so that two runs of one suite number the same scenes alike.
    """
    if shown.empty:
        return Estimate(float("nan"), 0)
    scenes = np.unique(records["scene"].to_numpy(np.int64))
    scene = np.searchsorted(scenes, shown["scene"].to_numpy(np.int64))
    value = float(of_rows(np.ones((1, len(shown))))[0])
    weighted = partial(_of_scenes, of_rows, scene)
    return Estimate(value, counted, scenes.size, weighted if scenes.size > 1 else None)


def _of_scenes(of_rows: Weighted, scene: NDArray[np.intp], weights: Floats) -> Floats:
    return of_rows(weights[:, scene])
