"""Measurers of known verdict on one experiment: records fed with truth, or with other rocks'."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from validation.scores.expectations import TRUTH, Claim
from validation.scores.judge import Feeds

SCENE = ["experiment", "series", "scene"]
_TRUE = {"row": "truth_row", "col": "truth_col", "axis_a_m": "truth_axis_a_m"}


def found_all(records: pd.DataFrame) -> pd.DataFrame:
    """Copy in which every true rock is found, with its own mask, and nothing else."""
    fed = records[records["status"] != "extra"].copy()
    rocks = fed["status"] != "view"  # a view without rocks has a row too
    fed.loc[rocks, "status"] = "matched"
    fed.loc[rocks, "iou"] = 1.0
    for column, truth in _TRUE.items():
        if truth in fed:
            fed[column] = fed[truth]
    return fed


def missed_all(records: pd.DataFrame) -> pd.DataFrame:
    """Copy in which no found rock is where a true one is."""
    fed = records.copy()
    found = fed["status"] == "matched"
    fed.loc[found, "status"] = "missed"
    fed.loc[found, "iou"] = np.nan
    return fed


def claimed_truth(records: pd.DataFrame, claims: Sequence[Claim]) -> pd.DataFrame:
    """Records in which every rock is found and every column is the truth it claims."""
    fed = found_all(records)
    for claim in claims:
        rows = fed["experiment"] == claim.experiment
        rows &= (fed["series"] == claim.series) & (fed["method"] == claim.method)
        if rows.any():
            fed.loc[rows, claim.measure] = fed.loc[rows, claim.truth]
    return fed


def shuffled_truth(records: pd.DataFrame, rng: np.random.Generator) -> pd.DataFrame:
    """Oracle's records with each scene's truth dealt out anew among its rocks.

    All views and methods of a scene get the same deal, so that agreement between views stays
    perfect and only the order against the truth is lost.
    """
    fed = records.copy()
    columns = [name for name in fed.columns if name.startswith(TRUTH)]
    for _, scene in fed.groupby(SCENE, sort=True):
        instances = np.sort(scene["instance"].unique())
        dealt = dict(zip(instances, rng.permutation(instances), strict=True))
        source = scene.drop_duplicates("instance").set_index("instance")[columns]
        fed.loc[scene.index, columns] = source.loc[scene["instance"].map(dealt)].to_numpy()
    return fed


def mixed_values(
    records: pd.DataFrame, claims: Sequence[Claim], rng: np.random.Generator
) -> pd.DataFrame:
    """Records with each view's measured values dealt out anew among its rocks.

    The values are as they were measured, but no rock keeps its own from one view to the next: a
    gate on how well a rock's value holds must fail.
    """
    fed = records.copy()
    columns = list(dict.fromkeys(claim.measure for claim in claims))
    for _, view in fed[fed["status"] == "matched"].groupby([*SCENE, "view", "method"], sort=True):
        fed.loc[view.index, columns] = view[columns].to_numpy()[rng.permutation(len(view))]
    return fed


CLAIMED = Feeds(oracle=claimed_truth, shuffled=shuffled_truth, mixed=mixed_values)
