"""Measurers whose verdict is known before: one that knows the truth and two that know nothing.

They go through the same scoring and the same gates as a real run. If the oracle failed a gate, or
one of the others passed them all, the gates would be wrong and not the measures.
"""

from collections.abc import Iterator

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.claims import SHAPES_CLAIMS, YARD_CLAIMS, Claim


def _claims(records: pd.DataFrame) -> Iterator[tuple[NDArray[np.bool_], Claim]]:
    yard = (records["kind"] == "yard").to_numpy()
    for claims in YARD_CLAIMS.values():
        for claim in claims:
            yield yard, claim
    for series, claims in SHAPES_CLAIMS.items():
        rows = ((records["kind"] == "shapes") & (records["series"] == series)).to_numpy()
        for claim in claims:
            yield rows, claim


def oracle(records: pd.DataFrame) -> pd.DataFrame:
    """Return records in which every rock is found and every measure is the truth it claims."""
    fed = records[records["status"] != "extra"].copy()
    fed["status"] = "matched"
    fed["iou"] = 1.0
    for rows, claim in _claims(fed):
        if rows.any():
            fed.loc[rows, claim.measure] = fed.loc[rows, claim.truth]
    return fed


def shuffled(records: pd.DataFrame, *, rng: np.random.Generator) -> pd.DataFrame:
    """Return the oracle's records with each scene's truth dealt out anew among its rocks.

    All views of a scene get the same deal, so that agreement between views stays perfect and only
    the order against the truth is lost.
    """
    fed = oracle(records)
    columns = [name for name in fed.columns if name.startswith("truth_")]
    for _, scene in fed.groupby(["experiment", "series", "scene"], sort=True):
        instances = np.sort(scene["instance"].unique())
        dealt = dict(zip(instances, rng.permutation(instances), strict=True))
        source = scene.drop_duplicates("instance").set_index("instance")[columns]
        fed.loc[scene.index, columns] = source.loc[scene["instance"].map(dealt)].to_numpy()
    return fed


def mixed(records: pd.DataFrame, *, rng: np.random.Generator) -> pd.DataFrame:
    """Return the records with each view's measured values dealt out anew among its rocks.

    The values are as they were measured, but no rock keeps its own from one view to the next: a
    gate on how well a rock's value holds must fail.
    """
    fed = records.copy()
    columns = list(dict.fromkeys(claim.measure for _, claim in _claims(records)))
    found = fed[fed["status"] == "matched"]
    for _, view in found.groupby(["experiment", "series", "scene", "view"], sort=True):
        fed.loc[view.index, columns] = view[columns].to_numpy()[rng.permutation(len(view))]
    return fed
