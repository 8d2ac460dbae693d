"""Scores of a segmentation, way by way: of all objects, and by width and depth."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from validation.kinds.segmentation.baselines import BASELINES
from validation.kinds.segmentation.sources import source_of, split_series
from validation.kinds.segmentation.spec import SegmentationExperiment
from validation.peers import MeasureSpec
from validation.scores.object_scores import (
    Compute,
    between,
    f1,
    number_of,
    of_matched,
    precision,
    range_name,
    recall,
    share_of,
)
from validation.scores.score import Better, Definition, Estimate, Key
from validation.statistics.weighted import mean, median

SIZES_PX = ((12, 24), (24, 48), (48, np.inf))
DEPTHS_M = ((0, 4), (4, 6), (6, 8), (8, np.inf))
_SCENE = ("scene",)  # what is drawn for intervals


def ground_error(records: pd.DataFrame) -> Estimate:
    """Median over views of the ground's RMS error in the range's noise."""
    views = records.drop_duplicates(["scene", "view"])["ground_sigmas"].dropna()
    value = float(views.median()) if len(views) else float("nan")
    return Estimate(value, len(views))


_WHOLE: tuple[tuple[str, str, str, str, Better, Compute], ...] = (
    ("f1", "objects found (F1 at IoU > 0.5)", "1", "rocks in views", "higher",
     share_of(f1, _SCENE)),
    ("precision", "found objects that are rocks", "share", "rocks in views", "higher",
     share_of(precision, _SCENE)),
    ("recall", "rocks found", "share", "rocks in views", "higher", share_of(recall, _SCENE)),
    ("mean_iou", "overlap of the found masks (mean IoU)", "1", "found rocks", "higher",
     of_matched("iou", mean, _SCENE)),
    ("boundary_px", "distance of the outlines, median", "px", "found rocks", "lower",
     of_matched("boundary_px", median, _SCENE)),
    ("splits", "rocks found in pieces", "rocks", "rocks in views", "lower", number_of("split")),
    ("merges", "rocks found as one with another", "rocks", "rocks in views", "lower",
     number_of("merged")),
    ("ground_error", "ground's RMS error over the range's noise, median", "σ", "views", "lower",
     ground_error),
)  # fmt: skip


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
                    f"f1_{key}_{range_name(low, high)}",
                    f"F1 of objects of {key} {low:g} {until} {unit}",
                    "1",
                    "rocks in views",
                    "higher",
                    between(share_of(f1, _SCENE), column, low, high),
                )
            )
    return rows


def _has_ground(series: str) -> bool:
    """Whether the way fits a ground, as methods do and baselines do not, and has range for it."""
    way, _ = split_series(series)
    return way not in BASELINES and source_of(series).has_range


def definitions(
    experiment: SegmentationExperiment,
    _measures: Sequence[MeasureSpec],
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
