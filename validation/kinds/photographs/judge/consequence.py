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
from validation.scores.score import Estimate
from validation.statistics.weighted import mean

AXES = {"least_axis_px": "least axis", "greatest_axis_px": "greatest axis"}
SHAPES = {
    "axis_ratio": "axis ratio",
    "angularity_2d": "angularity",
    "roundness": "roundness",
}
PERCENTILES = (16, 50, 84)

Difference = Callable[[Floats, Floats], Floats]  # of found and true values


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


def _over_pictures(column: str, percent: float, value: Callable[[Floats], Floats]) -> Compute:
    """Mean over pictures of a value of their ratios."""

    def compute(records: pd.DataFrame) -> Estimate:
        ratios = percentile_ratios(records, column, percent)
        shown = pd.DataFrame({"scene": ratios.index})
        values = value(ratios.to_numpy(np.float64))
        return of_groups(partial(mean, values), shown, records, PICTURE, counted=len(values))

    return compute


def spread(values: Floats, weights: Floats) -> Floats:
    """Weighted standard deviation, (draws,); NaN of fewer than two values."""
    variance = mean(values**2, weights) - mean(values, weights) ** 2
    several = weights.sum(axis=1) >= 2
    return np.where(several, np.sqrt(np.maximum(variance, 0.0)), np.nan)


def _of_pairs(
    column: str, difference: Difference, statistic: Callable[[Floats, Floats], Floats]
) -> Compute:
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
            bias = _over_pictures(column, percent, lambda ratios: ratios - 1)
            error = _over_pictures(column, percent, lambda ratios: np.abs(ratios - 1))
            name, of = f"d{percent}", f"D{percent} of the {title}"
            yield ScoreOf(
                f"{name}_bias",
                f"{of}, mean over true − 1",
                "1",
                "pictures",
                "neither",
                bias,
                column,
            )
            yield ScoreOf(
                f"{name}_error", f"{of}, mean |over true − 1|", "1", "pictures", "lower", error,
                column,
            )  # fmt: skip
    for difference, kind, columns in ((_relative, "relative", AXES), (_absolute, "", SHAPES)):
        for column, title in columns.items():
            what = f"{title}, {kind} ".rstrip(" ,") if kind else title
            yield ScoreOf(
                "bias", f"{what} bias", "1", "found rocks", "neither",
                _of_pairs(column, difference, mean), column,
            )  # fmt: skip
            yield ScoreOf(
                "spread", f"{what} spread (standard deviation)", "1", "found rocks", "lower",
                _of_pairs(column, difference, spread), column,
            )  # fmt: skip
            yield ScoreOf(
                "coverage", f"{title}: share of rocks that have it", "share", "rocks", "higher",
                _coverage(column), column,
            )  # fmt: skip
