"""Scores of a segmentation, way by way: of all objects, and by width and depth."""

from collections.abc import Sequence

import numpy as np

from validation.kinds.segmentation.baselines import BASELINES
from validation.kinds.segmentation.judge.statistics import (
    Compute,
    f1,
    f1_between,
    ground_error,
    number_of,
    of_matched,
    precision,
    recall,
    share_of,
)
from validation.kinds.segmentation.sources import source_of, split_series
from validation.kinds.segmentation.spec import SegmentationExperiment
from validation.peers import MeasureSpec
from validation.scores.score import Better, Definition, Key
from validation.statistics.weighted import mean, median

SIZES_PX = ((12, 24), (24, 48), (48, np.inf))
DEPTHS_M = ((0, 4), (4, 6), (6, 8), (8, np.inf))

_WHOLE: tuple[tuple[str, str, str, str, Better, Compute], ...] = (
    ("f1", "objects found (F1 at IoU > 0.5)", "1", "rocks in views", "higher", share_of(f1)),
    ("precision", "found objects that are rocks", "share", "rocks in views", "higher",
     share_of(precision)),
    ("recall", "rocks found", "share", "rocks in views", "higher", share_of(recall)),
    ("mean_iou", "overlap of the found masks (mean IoU)", "1", "found rocks", "higher",
     of_matched("iou", mean)),
    ("boundary_px", "distance of the outlines, median", "px", "found rocks", "lower",
     of_matched("boundary_px", median)),
    ("splits", "rocks found in pieces", "rocks", "rocks in views", "lower", number_of("split")),
    ("merges", "rocks found as one with another", "rocks", "rocks in views", "lower",
     number_of("merged")),
    ("ground_error", "ground's RMS error over the range's noise, median", "σ", "views", "lower",
     ground_error),
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
                    f1_between(column, low, high),
                )
            )
    return rows


def _has_ground(series: str) -> bool:
    """Whether the way fits a ground, as methods do and baselines do not, and has range for it."""
    way, _ = split_series(series)
    return way not in BASELINES and source_of(series).has_range


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
