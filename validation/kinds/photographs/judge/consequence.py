"""Consequence of finding for what is measured: grain sizes and shapes of found outlines.

Each reading of a found outline is held to the same reading of the true one.
"""

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
import pandas as pd

from validation.arrays import Floats
from validation.kinds.photographs.judge.record import BLOCK, PICTURE, ScoreOf
from validation.kinds.photographs.readings import TRUE
from validation.scores.object_scores import Compute, of_groups
from validation.scores.score import Better, Estimate
from validation.statistics.weighted import mean

AXES = {"least_axis_px": "least axis", "greatest_axis_px": "greatest axis"}
SHAPES = {
    "axis_ratio": "axis ratio",
    "angularity_2d": "angularity",
    "roundness": "roundness",
}
PERCENTILES = (16, 50, 84)

Difference = Callable[[Floats, Floats], Floats]  # of found and true values
Pooled = Callable[[Floats, Floats], Floats]  # of values (n,) and their weights (draws, n)


def _relative(found: Floats, true: Floats) -> Floats:
    return found / true - 1


def _absolute(found: Floats, true: Floats) -> Floats:
    return found - true


def percentile_ratios(records: pd.DataFrame, column: str, percent: float) -> pd.Series:
    """Percentile of the found objects' readings over that of the true ones, by picture.

    Percentiles are by number of grains; a picture without found objects has none.
    """
    true = records[records["status"].isin(["matched", "missed"])].groupby("scene")[TRUE + column]
    found = records[records["status"].isin(["matched", "extra"])].groupby("scene")[column]
    return (found.quantile(percent / 100) / true.quantile(percent / 100)).dropna()


def _over_pictures(
    column: str, percent: float, statistic: Pooled, value: Callable[[Floats], Floats]
) -> Compute:
    """Statistic over pictures of a value of their ratios."""

    def compute(records: pd.DataFrame) -> Estimate:
        ratios = percentile_ratios(records, column, percent)
        shown = pd.DataFrame({"scene": ratios.index})
        values = value(ratios.to_numpy(np.float64))
        return of_groups(partial(statistic, values), shown, records, PICTURE, counted=len(values))

    return compute


def spread(values: Floats, weights: Floats) -> Floats:
    """Weighted standard deviation, (draws,); NaN of fewer than two values."""
    variance = mean(values**2, weights) - mean(values, weights) ** 2
    several = weights.sum(axis=1) >= 2
    return np.where(several, np.sqrt(np.maximum(variance, 0.0)), np.nan)


def _of_pairs(column: str, difference: Difference, statistic: Pooled) -> Compute:
    """Statistic of the differences of matched objects with both readings."""

    def compute(records: pd.DataFrame) -> Estimate:
        matched = records[records["status"] == "matched"]
        shown = matched.dropna(subset=[column, TRUE + column])
        found, true = (shown[name].to_numpy(np.float64) for name in (column, TRUE + column))
        values = difference(found, true)
        return of_groups(partial(statistic, values), shown, records, BLOCK, counted=len(shown))

    return compute


def _coverage(column: str) -> Compute:
    """Share of the true objects with a reading whose found one has it too."""

    def compute(records: pd.DataFrame) -> Estimate:
        true = records[records["status"].isin(["matched", "missed"])]
        shown = true[true[TRUE + column].notna()]
        read = (shown["status"] == "matched") & shown[column].notna()
        values = np.asarray(read, dtype=np.float64)
        return of_groups(partial(mean, values), shown, records, BLOCK, counted=len(shown))

    return compute


def consequence_scores() -> Iterator[ScoreOf]:
    """Scores of the grain sizes of pictures, then of the readings of single rocks."""
    for column, title in AXES.items():
        for percent in PERCENTILES:
            yield from _of_percentile(column, percent, f"D{percent} of the {title}")
        yield from _of_readings(column, f"{title}, relative", _relative)
    for column, title in SHAPES.items():
        yield from _of_readings(column, title, _absolute)


def _of_percentile(column: str, percent: int, title: str) -> Iterator[ScoreOf]:
    over: tuple[tuple[str, str, Better, Pooled, Callable[[Floats], Floats]], ...] = (
        ("bias", "mean over true − 1", "neither", mean, lambda ratios: ratios - 1),
        ("spread", "standard deviation of over true", "lower", spread, lambda ratios: ratios),
        ("error", "mean |over true − 1|", "lower", mean, lambda ratios: np.abs(ratios - 1)),
    )
    for name, what, better, statistic, value in over:
        compute = _over_pictures(column, percent, statistic, value)
        key = f"d{percent}_{name}"
        yield ScoreOf(key, f"{title}, {what}", "1", "pictures", better, compute, column)


def _of_readings(column: str, title: str, difference: Difference) -> Iterator[ScoreOf]:
    bias, scatter = (_of_pairs(column, difference, statistic) for statistic in (mean, spread))
    yield ScoreOf("bias", f"{title}: bias", "1", "found rocks", "neither", bias, column)
    yield ScoreOf("spread", f"{title}: spread", "1", "found rocks", "lower", scatter, column)
    covered = _coverage(column)
    yield ScoreOf("coverage", f"{title}: coverage", "share", "rocks", "higher", covered, column)
