"""Scores of a segmentation: objects found, how well their masks fit, and the ground under them."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.kinds.segmentation.baselines import BASELINES
from validation.kinds.segmentation.sources import source_of, split_series
from validation.kinds.segmentation.spec import SegmentationExperiment
from validation.peers import MeasureSpec
from validation.scores.expectations import Claim
from validation.scores.judge import Feeds
from validation.scores.score import Better, Definition, Estimate, Key
from validation.selfcheck.feeds import found_all, missed_all

SIZES_PX = ((12, 24), (24, 48), (48, np.inf))
DEPTHS_M = ((0, 4), (4, 6), (6, 8), (8, np.inf))

Compute = Callable[[pd.DataFrame], Estimate]
_Value = Callable[[NDArray[Any]], float]


def _by_scene(
    value: _Value, column: str, shown: pd.DataFrame, records: pd.DataFrame, *, count: int
) -> Estimate:
    """Statistic of a column of the shown rows, with a weight for each scene.

    All scenes count, shown or not, so that two runs of one suite number the same scenes alike.
    """
    scenes = np.unique(records["scene"].to_numpy(np.int64))
    scene = np.searchsorted(scenes, shown["scene"].to_numpy(np.int64))
    values = shown[column].to_numpy()
    if values.size == 0:
        return Estimate(float("nan"), 0)

    def weighted(weights: NDArray[np.float64]) -> float:
        drawn = np.repeat(values, weights[scene].astype(np.intp))
        return value(drawn) if drawn.size else float("nan")

    several = scenes.size > 1
    return Estimate(value(values), count, scenes.size, weighted if several else None)


def _share(good: int, all_of: int) -> float:
    return good / all_of if all_of else float("nan")


def _counts(status: NDArray[Any]) -> tuple[int, int, int]:
    matched, missed, extra = (
        int(np.count_nonzero(status == name)) for name in ("matched", "missed", "extra")
    )
    return matched, missed, extra


def f1(status: NDArray[Any]) -> float:
    """2 TP/(2 TP + FN + FP)."""
    matched, missed, extra = _counts(status)
    return _share(2 * matched, 2 * matched + missed + extra)


def precision(status: NDArray[Any]) -> float:
    """TP/(TP + FP)."""
    matched, _, extra = _counts(status)
    return _share(matched, matched + extra)


def recall(status: NDArray[Any]) -> float:
    """TP/(TP + FN)."""
    matched, missed, _ = _counts(status)
    return _share(matched, matched + missed)


def _of_matched(column: str, value: _Value) -> Compute:
    def compute(records: pd.DataFrame) -> Estimate:
        shown = records[records["status"] == "matched"]
        return _by_scene(value, column, shown, records, count=len(shown))

    return compute


def _ratio(value: _Value) -> Compute:
    def compute(records: pd.DataFrame) -> Estimate:
        shown = records[records["status"].isin(["matched", "missed", "extra"])]
        count = int((shown["status"] != "extra").sum())
        return _by_scene(value, "status", shown, records, count=count)

    return compute


def _number(column: str) -> Compute:
    def compute(records: pd.DataFrame) -> Estimate:
        own = records[records["status"].isin(["matched", "missed"])]
        return Estimate(float(own[column].astype(bool).sum()), len(own))

    return compute


def _ground(records: pd.DataFrame) -> Estimate:
    """Median over views of the ground's RMS error in the range's noise."""
    views = records.drop_duplicates(["scene", "view"])["ground_sigmas"].dropna()
    value = float(views.median()) if len(views) else float("nan")
    return Estimate(value, len(views))


def _between(column: str, low: float, high: float) -> Compute:
    whole = _ratio(f1)

    def compute(records: pd.DataFrame) -> Estimate:
        inside = (records[column] >= low) & (records[column] < high)
        return whole(records.assign(status=records["status"].where(inside, "elsewhere")))

    return compute


_WHOLE: tuple[tuple[str, str, str, str, Better, Compute], ...] = (
    ("f1", "objects found (F1 at IoU > 0.5)", "1", "rocks in views", "higher", _ratio(f1)),
    ("precision", "found objects that are rocks", "share", "rocks in views", "higher",
     _ratio(precision)),
    ("recall", "rocks found", "share", "rocks in views", "higher", _ratio(recall)),
    ("mean_iou", "overlap of the found masks (mean IoU)", "1", "found rocks", "higher",
     _of_matched("iou", lambda values: float(np.mean(values)))),
    ("boundary_px", "distance of the outlines, median", "px", "found rocks", "lower",
     _of_matched("boundary_px", lambda values: float(np.median(values)))),
    ("splits", "rocks found in pieces", "rocks", "rocks in views", "lower", _number("split")),
    ("merges", "rocks found as one with another", "rocks", "rocks in views", "lower",
     _number("merged")),
    ("ground_error", "ground's RMS error over the range's noise, median", "σ", "views", "lower",
     _ground),
)  # fmt: skip


def _name(low: float, high: float) -> str:
    return f"{low:g}_up" if np.isinf(high) else f"{low:g}_{high:g}"


def _binned() -> list[tuple[str, str, str, str, Better, Compute]]:
    rows: list[tuple[str, str, str, str, Better, Compute]] = []
    for column, key, unit, bins in (
        ("width_px", "width", "px", SIZES_PX),
        ("depth_m", "depth", "m", DEPTHS_M),
    ):
        for low, high in bins:
            until = "and more" if np.isinf(high) else f"to {high:g}"
            rows.append(
                (
                    f"f1_{key}_{_name(low, high)}",
                    f"F1 of objects of {key} {low:g} {until} {unit}",
                    "1",
                    "rocks in views",
                    "higher",
                    _between(column, low, high),
                )
            )
    return rows


def _has_ground(series: str) -> bool:
    """Whether the way fits a ground, as methods do and baselines do not, and has range for it."""
    way, _ = split_series(series)
    return way not in BASELINES and source_of(series).has_range


def claims(
    experiment: SegmentationExperiment,  # noqa: ARG001
    measures: Sequence[MeasureSpec],  # noqa: ARG001
) -> tuple[Claim, ...]:
    """None: a segmentation measures nothing."""
    return ()


view_claims = ranked_claims = claims


def definitions(
    experiment: SegmentationExperiment,
    measures: Sequence[MeasureSpec],  # noqa: ARG001
) -> tuple[Definition, ...]:
    """Scores of an experiment, way by way."""

    def own(series: str, compute: Compute) -> Compute:
        return lambda records: compute(
            records[(records["experiment"] == experiment.name) & (records["series"] == series)]
        )

    return tuple(
        Definition(
            key=Key(experiment.name, "", series, "", key),
            title=f"{series}: {title}",
            unit=unit,
            counted=counted,
            better=better,
            compute=own(series, compute),
        )
        for series in experiment.series
        for key, title, unit, counted, better, compute in (*_WHOLE, *_binned())
        if key != "ground_error" or _has_ground(series)
    )


_FAULTLESS = {"boundary_px": 0.0, "split": False, "merged": False, "ground_sigmas": 0.0}


def _oracle(records: pd.DataFrame, claims: Sequence[Claim]) -> pd.DataFrame:  # noqa: ARG001
    """Records in which every rock is found to the pixel, and the ground with it."""
    fed = found_all(records)
    for column, value in _FAULTLESS.items():
        fed[column] = value
    return fed


FEEDS = Feeds(
    oracle=_oracle,
    shuffled=lambda records, rng: missed_all(records),  # noqa: ARG005
    mixed=lambda records, claims, rng: missed_all(records),  # noqa: ARG005
)
