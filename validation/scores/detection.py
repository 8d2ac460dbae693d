"""Whether the rocks were found, and how well their masks fit."""

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.scores.score import Estimate


def _by_rock(records: pd.DataFrame) -> tuple[NDArray[np.intp], int]:
    """Return each row's rock number among all rocks of all scenes, and how many there are."""
    groups = records.groupby(["scene", "instance"], sort=True)
    number: NDArray[np.intp] = np.asarray(groups.ngroup(), dtype=np.intp)
    return number, int(groups.ngroups)


def _share(good: NDArray[np.float64], rock: NDArray[np.intp], rocks: int) -> Estimate:
    if good.size == 0:
        return Estimate(float("nan"), 0)

    def share(weights: NDArray[np.float64]) -> float:
        row_weights = weights[rock]
        total = row_weights.sum()
        return float(row_weights @ good / total) if total > 0 else float("nan")

    return Estimate(float(good.mean()), int(good.size), rocks, share)


def recall(records: pd.DataFrame) -> Estimate:
    """Return the share of rocks in plain view that were found, over all views."""
    shown = records[(records["status"] != "extra") & records["eligible"].astype(bool)]
    found = np.asarray(shown["status"] == "matched", dtype=np.float64)
    return _share(found, *_by_rock(shown))


def precision(records: pd.DataFrame) -> Estimate:
    """Return the share of measured rocks that are true ones; no interval, extras have no rock."""
    measured = records[records["status"] != "missed"]
    matched = np.asarray(measured["status"] == "matched", dtype=np.float64)
    return Estimate(float(matched.mean()) if matched.size else float("nan"), int(matched.size))


def mean_iou(records: pd.DataFrame) -> Estimate:
    """Return the mean intersection over union of the found rocks' masks."""
    matched = records[(records["status"] == "matched") & records["eligible"].astype(bool)]
    return _share(matched["iou"].to_numpy(dtype=np.float64), *_by_rock(matched))
