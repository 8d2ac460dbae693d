"""Whether the rocks were found, and how well their masks fit."""

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.arrays import Floats
from validation.scores.score import Estimate
from validation.statistics.weighted import mean

_ROCK = ["scene", "instance"]


def rock_numbers(shown: pd.DataFrame, records: pd.DataFrame) -> tuple[NDArray[np.intp], int]:
    """Each shown row's rock number among all true rocks, and how many those are.

    All count, shown or not, so that two runs of one suite number the same rocks alike.
    """
    rocks = pd.MultiIndex.from_frame(records.loc[records["status"] != "extra", _ROCK])
    every = rocks.unique().sort_values()
    number = every.get_indexer(pd.MultiIndex.from_frame(shown[_ROCK]))
    return number.astype(np.intp), len(every)


def _share(good: Floats, rock: NDArray[np.intp], rocks: int) -> Estimate:
    if good.size == 0:
        return Estimate(float("nan"), 0)

    def share(weights: Floats) -> Floats:
        return mean(good, weights[:, rock])

    return Estimate(float(good.mean()), int(good.size), rocks, share)


def recall(records: pd.DataFrame) -> Estimate:
    """Share of rocks in plain view that were found, over all views."""
    shown = records[(records["status"] != "extra") & records["eligible"].astype(bool)]
    found = np.asarray(shown["status"] == "matched", dtype=np.float64)
    return _share(found, *rock_numbers(shown, records))


def precision(records: pd.DataFrame) -> Estimate:
    """Share of measured rocks that are true ones; no interval, extras have no rock."""
    measured = records[records["status"] != "missed"]
    matched = np.asarray(measured["status"] == "matched", dtype=np.float64)
    return Estimate(float(matched.mean()) if matched.size else float("nan"), int(matched.size))


def mean_iou(records: pd.DataFrame) -> Estimate:
    """Mean intersection over union of the found rocks' masks."""
    matched = records[(records["status"] == "matched") & records["eligible"].astype(bool)]
    return _share(matched["iou"].to_numpy(dtype=np.float64), *rock_numbers(matched, records))
