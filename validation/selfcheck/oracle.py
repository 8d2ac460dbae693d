"""Measurers whose verdict is known before: one that knows the truth and two that know nothing.

They go through the same scoring and the same gates as a real run. If the oracle failed a gate, or
one of the others passed them all, the gates would be wrong and not the measures. Gates on a level
are left out: the truth has no degrees.
"""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from validation.kinds.design.oracle import knowing
from validation.scores.expectations import Claim

_SCENE = ["experiment", "series", "scene"]
_TRUE = {"row": "truth_row", "col": "truth_col", "axis_a_m": "truth_axis_a_m"}
_FAULTLESS = {"boundary_px": 0.0, "split": False, "merged": False, "ground_sigmas": 0.0}


def _is_segmented(records: pd.DataFrame) -> "pd.Series[bool]":
    return records["kind"] == "segmentation"


def _is_unclaimed(records: pd.DataFrame) -> "pd.Series[bool]":
    return records["kind"].isin(["segmentation", "design"])


def _unmatched(records: pd.DataFrame) -> pd.DataFrame:
    """Return a copy in which rocks of no claim, segmented or of a design, are not found."""
    fed = records.copy()
    found = _is_unclaimed(fed) & (fed["status"] == "matched")
    fed.loc[found, "status"] = "missed"
    fed.loc[found, "iou"] = np.nan
    return fed


def oracle(records: pd.DataFrame, claims: Sequence[Claim]) -> pd.DataFrame:
    """Return records in which every rock is found and every measure is the truth it claims.

    In a designed experiment, which claims nothing, only the view moves a value.
    """
    fed = records[records["status"] != "extra"].copy()
    rocks = fed["status"] != "view"
    fed.loc[rocks, "status"] = "matched"
    fed.loc[rocks, "iou"] = 1.0
    for column, value in _FAULTLESS.items():
        if column in fed:
            fed.loc[_is_segmented(fed), column] = value
    for column, truth in _TRUE.items():
        if truth in fed:
            fed[column] = fed[truth]
    for claim in claims:
        rows = fed["experiment"] == claim.experiment
        rows &= (fed["series"] == claim.series) & (fed["method"] == claim.method)
        fed.loc[rows, claim.measure] = fed.loc[rows, claim.truth]
    designed = fed["kind"] == "design"
    if designed.any():
        fed = pd.concat([fed[~designed], knowing(fed[designed])]).sort_index()
    return fed


def shuffled(
    records: pd.DataFrame, claims: Sequence[Claim], *, rng: np.random.Generator
) -> pd.DataFrame:
    """Return the oracle's records with each scene's truth dealt out anew among its rocks.

    All views and methods of a scene get the same deal, so that agreement between views stays
    perfect and only the order against the truth is lost. Of a segmentation and of a design no rock
    is where a true one is.
    """
    fed = _unmatched(oracle(records, claims))
    columns = [name for name in fed.columns if name.startswith("truth_")]
    for _, scene in fed[~_is_unclaimed(fed)].groupby(_SCENE, sort=True):
        instances = np.sort(scene["instance"].unique())
        dealt = dict(zip(instances, rng.permutation(instances), strict=True))
        source = scene.drop_duplicates("instance").set_index("instance")[columns]
        fed.loc[scene.index, columns] = source.loc[scene["instance"].map(dealt)].to_numpy()
    return fed


def mixed(
    records: pd.DataFrame, claims: Sequence[Claim], *, rng: np.random.Generator
) -> pd.DataFrame:
    """Return the records with each view's measured values dealt out anew among its rocks.

    The values are as they were measured, but no rock keeps its own from one view to the next: a
    gate on how well a rock's value holds must fail. Of a segmentation and of a design no rock is
    where a true one is.
    """
    fed = _unmatched(records)
    columns = list(dict.fromkeys(claim.measure for claim in claims))
    found = fed[(fed["status"] == "matched") & ~_is_unclaimed(fed)]
    for _, view in found.groupby([*_SCENE, "view", "method"], sort=True):
        fed.loc[view.index, columns] = view[columns].to_numpy()[rng.permutation(len(view))]
    return fed
