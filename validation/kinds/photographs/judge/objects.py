"""Objects found, by size, and pixels."""

from collections.abc import Iterator

import numpy as np
import pandas as pd

from validation.arrays import Floats
from validation.kinds.photographs.judge.record import BLOCK, ScoreOf
from validation.scores.object_scores import (
    Compute,
    Counts,
    between,
    f1,
    number_of,
    of_groups,
    of_matched,
    precision,
    range_name,
    recall,
    share_of,
)
from validation.scores.score import Estimate
from validation.statistics.weighted import mean, ratio

SIZES_PX = ((12, 16), (16, 32), (32, 64), (64, 128), (128, np.inf))
THRESHOLDS = np.arange(50, 100, 5) / 100
COUNTED = "rocks"


def average_precision(matched: Floats, true: Floats, found: Floats) -> Floats:
    """Mean over IoU thresholds of precision times recall, (draws,).

    matched (draws, thresholds) are the matches at each, true and found (draws,) all objects. It is
    COCO's area under precision over recall for a finder that is as sure of one object as of
    another: precision up to its recall, and 0 beyond. 0 where nothing is found.
    """
    squares = (matched**2).mean(axis=1)
    return np.where(found > 0, ratio(squares, true * np.maximum(found, 1)), ratio(0 * true, true))


def _average_precision(records: pd.DataFrame) -> Estimate:
    shown = records[records["status"].isin(Counts._fields)]
    status = shown["status"].to_numpy()
    matches = shown["iou"].fillna(0.0).to_numpy(np.float64)[:, None] > THRESHOLDS
    true, found = status != "extra", status != "missed"
    return of_groups(
        lambda weights: average_precision(weights @ matches, weights @ true, weights @ found),
        shown,
        records,
        BLOCK,
        counted=int(true.sum()),
    )


def _pixel_iou(records: pd.DataFrame) -> Estimate:
    shown = records[records["status"] == "view"]
    common, union = shown["common_px"].to_numpy(), shown["union_px"].to_numpy()
    return of_groups(
        lambda weights: ratio(weights @ common, weights @ union),
        shown,
        records,
        BLOCK,
        counted=shown["scene"].nunique(),
    )


_WHOLE: tuple[tuple[str, str, Compute], ...] = (
    ("f1", "objects found (F1 at IoU > 0.5)", share_of(f1, BLOCK)),
    ("precision", "found objects that are rocks", share_of(precision, BLOCK)),
    ("recall", "rocks found", share_of(recall, BLOCK)),
    ("ap", "average precision, IoU 0.50 to 0.95", _average_precision),
)


def object_scores() -> Iterator[ScoreOf]:
    """Scores of all objects, then of those of a size."""
    for name, title, compute in _WHOLE:
        yield ScoreOf(name, title, "1", COUNTED, "higher", compute)
    overlap = of_matched("iou", mean, BLOCK)
    title = "overlap of the found masks (mean IoU)"
    yield ScoreOf("mean_iou", title, "1", "found rocks", "higher", overlap)
    for name, title, column in (
        ("splits", "rocks found in pieces", "split"),
        ("merges", "rocks found as one with another", "merged"),
    ):
        yield ScoreOf(name, title, "rocks", COUNTED, "lower", number_of(column))
    for low, high in SIZES_PX:
        until = "and more" if np.isinf(high) else f"to {high:g}"
        for name, title, compute in _WHOLE:
            yield ScoreOf(
                f"{name}_{range_name(low, high)}",
                f"{title}, {low:g} {until} px",
                "1",
                COUNTED,
                "higher",
                between(compute, "width_px", low, high),
            )


def pixel_scores() -> Iterator[ScoreOf]:
    """Score of pixels, which needs no rocks told apart."""
    yield ScoreOf("pixel_iou", "pixels of rock (IoU)", "1", "pictures", "higher", _pixel_iou)
