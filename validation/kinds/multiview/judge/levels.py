"""How great the measured values are, and how far from the truth where they are one quantity.

Order says nothing of these: a value in radians for degrees, diameters for half-axes or a centre
half a pixel off leaves every order as it was.
"""

from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from rockshape.method import measure_of
from validation.arrays import Floats
from validation.kinds.multiview.judge.detection import rock_numbers
from validation.scores.agreement import Statistic
from validation.scores.expectations import Claim
from validation.scores.score import Estimate
from validation.statistics import Block
from validation.statistics.interval import of_sample
from validation.statistics.weighted import lower_median, mean, ratio, square_sum

LARGE_PX = 30.0  # diameter of the ball of a rock's half-axes, from which values are expected


def _pooled(
    values: Floats, rock: NDArray[np.intp], rocks: int, total: Callable[[Floats, Floats], Floats]
) -> Estimate:
    """Statistic `total(values, weights)` of pooled values, their weights (draws, values)."""
    keep = np.isfinite(values)
    values, rock = values[keep], rock[keep]
    if values.size == 0:
        return Estimate(float("nan"), 0)

    def weighted(weights: Floats) -> Floats:
        return total(values, weights[:, rock])

    return Estimate(of_sample(weighted, rocks), int(values.size), rocks, weighted)


def _rms(values: Floats, weights: Floats) -> Floats:
    return np.sqrt(mean(values**2, weights))


def _in_plain_view(records: pd.DataFrame) -> pd.DataFrame:
    return records[(records["status"] == "matched") & records["eligible"].astype(bool)]


def centre_px(records: pd.DataFrame) -> Estimate:
    """RMS distance of the measured centres from those of the true visible masks."""
    shown = _in_plain_view(records)
    off = np.hypot(
        shown["row"].to_numpy(np.float64) - shown["truth_row"].to_numpy(np.float64),
        shown["col"].to_numpy(np.float64) - shown["truth_col"].to_numpy(np.float64),
    )
    return _pooled(off, *rock_numbers(shown, records), _rms)


def axis_a(records: pd.DataFrame) -> Estimate:
    """Median ratio of the measured to the true longest half-axis."""
    shown = _in_plain_view(records)
    relative = shown["axis_a_m"].to_numpy(np.float64) / shown["truth_axis_a_m"].to_numpy(np.float64)
    return _pooled(relative, *rock_numbers(shown, records), lower_median)


def axes_error(records: pd.DataFrame) -> Estimate:
    """Mean absolute relative error of the half-axes."""
    shown = _in_plain_view(records)
    rock, rocks = rock_numbers(shown, records)
    measured, true = (
        shown[[f"{kind}axis_{axis}_m" for axis in "abc"]].to_numpy(np.float64)
        for kind in ("", "truth_")
    )
    return _pooled(np.abs(measured / true - 1).ravel(), np.repeat(rock, 3), rocks, mean)


def answered(records: pd.DataFrame, column: str) -> Estimate:
    """Share of the found rocks in plain view that have a value."""
    shown = _in_plain_view(records)
    there = np.isfinite(shown[column].to_numpy(np.float64)).astype(np.float64)
    return _pooled(there, *rock_numbers(shown, records), mean)


def refused(records: pd.DataFrame, columns: Sequence[str]) -> Estimate:
    """Share of columns without a value, of the found rocks in plain view that are large enough.

    A rock is as large as the ball of its true half-axes, 2 (abc)^(1/3), is in the view.
    """
    shown = _in_plain_view(records)
    half_axes_m = shown[[f"truth_axis_{axis}_m" for axis in "abc"]].to_numpy(np.float64)
    across_px = 2 * np.cbrt(half_axes_m.prod(axis=1)) / shown["truth_pixel_m"].to_numpy(np.float64)
    shown = shown[across_px >= LARGE_PX]
    missing = np.isnan(shown[list(columns)].to_numpy(np.float64)).mean(axis=1)
    return _pooled(missing, *rock_numbers(shown, records), mean)


def _flat(blocks: Sequence[Block], *, less_truth: bool) -> tuple[Floats, NDArray[np.intp], int]:
    """All values of all blocks, or their differences from the truth, with their rocks."""
    values, rocks, count = [np.empty(0)], [np.empty(0, np.intp)], 0
    for block in blocks:
        shown = block.values - block.view_truth if less_truth else block.values
        values.append(shown.ravel())
        rocks.append(np.tile(np.arange(block.rocks) + count, block.values.shape[0]))
        count += block.rocks
    return np.concatenate(values), np.concatenate(rocks), count


def _slope(blocks: Sequence[Block]) -> Estimate:
    """Least-squares slope of measured on true values; 1 is calibrated if they are one quantity."""
    values, rock, rocks = _flat(blocks, less_truth=False)
    truth = np.concatenate([np.empty(0), *(block.view_truth.ravel() for block in blocks)])
    keep = np.isfinite(values) & np.isfinite(truth)
    values, truth, rock = values[keep], truth[keep], rock[keep]

    def slope(weights: Floats) -> Floats:
        own = weights[:, rock]
        off = truth - ratio((own * truth).sum(axis=1), own.sum(axis=1))[:, None]
        return ratio(np.vecdot(own, off * values), square_sum(truth, own))

    return Estimate(of_sample(slope, rocks), int(values.size), rocks, slope)


def _level(blocks: Sequence[Block]) -> Estimate:
    return _pooled(*_flat(blocks, less_truth=False), mean)


def _bias(blocks: Sequence[Block]) -> Estimate:
    return _pooled(*_flat(blocks, less_truth=True), mean)


def _error(blocks: Sequence[Block]) -> Estimate:
    return _pooled(*_flat(blocks, less_truth=True), _rms)


def _absolute_error(blocks: Sequence[Block]) -> Estimate:
    differences, rock, rocks = _flat(blocks, less_truth=True)
    return _pooled(np.abs(differences), rock, rocks, mean)


_VIEWS = "rock views"
_LEVEL = Statistic("level", "mean value", "", _VIEWS, "neither", _level)
_BIAS = Statistic("bias", "mean difference from the truth", "", _VIEWS, "neither", _bias)
_ERROR = Statistic("error", "RMS difference from the truth", "", _VIEWS, "lower", _error)
_ABSOLUTE_ERROR = Statistic(
    "absolute_error",
    "mean absolute difference from the truth",
    "",
    _VIEWS,
    "lower",
    _absolute_error,
)
_SLOPE = Statistic("slope", "slope of measured on true values", "1", _VIEWS, "neither", _slope)
DIFFERENCES = (_BIAS, _ERROR, _ABSOLUTE_ERROR, _SLOPE)


def of(claim: Claim) -> tuple[Statistic, ...]:
    """Statistics of a claim's level; its error where measure and truth are one quantity.

    A measure of ours without a unit has a slope on any truth.
    """
    if claim.same_quantity:
        return (_LEVEL, *DIFFERENCES)
    measure = measure_of(claim.measure)
    return (_LEVEL,) if measure is None or measure.unit else (_LEVEL, _SLOPE)
