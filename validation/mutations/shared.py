"""Errors of any measure: values dealt out, truth of other rocks, axes in the wrong order."""

import numpy as np
import pandas as pd

from validation.mutations.mutation import Mutation

SHAPES = ("shapes",)
YARD = ("yard",)
FORM = ("form",)
ROCKS = (*YARD, *FORM)
_SCENE = ["experiment", "series", "scene"]
_SEED = 60


def constant(column: str) -> Mutation:
    def fill(table: pd.DataFrame) -> pd.DataFrame:
        return table.assign(**{column: 1.0})

    experiments = (*SHAPES, *ROCKS)
    return Mutation(f"constant {column}", f"{column} is 1 for every rock", experiments, table=fill)


def lost(records: pd.DataFrame) -> pd.DataFrame:
    """Miss one rock in each view."""
    first = (records["instance"] == 0) & records["experiment"].isin(ROCKS)
    return records.assign(
        status=records["status"].mask(first & (records["status"] == "matched"), "missed")
    )


def stale(records: pd.DataFrame) -> pd.DataFrame:
    """Give each scene the truth of rocks dealt anew, as another seed would have made them."""
    rng = np.random.default_rng(_SEED)
    fed = records.copy()
    columns = [
        name
        for name in fed.columns
        if name.startswith("truth_") and name not in ("truth_row", "truth_col")
    ]
    for _, scene in fed[fed["status"] != "extra"].groupby(_SCENE, sort=True):
        instances = np.sort(scene["instance"].unique())
        dealt = dict(zip(instances, rng.permutation(instances), strict=True))
        source = scene.drop_duplicates("instance").set_index("instance")[columns]
        fed.loc[scene.index, columns] = source.loc[scene["instance"].map(dealt)].to_numpy()
    return fed


def shuffled(column: str) -> Mutation:
    def deal(records: pd.DataFrame) -> pd.DataFrame:
        rng = np.random.default_rng(_SEED)
        fed = records.copy()
        for _, view in fed[fed["status"] == "matched"].groupby([*_SCENE, "view"], sort=True):
            fed.loc[view.index, column] = rng.permutation(view[column].to_numpy())
        return fed

    return Mutation(
        f"shuffled {column}", f"{column} dealt out among a view's rocks", (), records=deal
    )


def unsorted(table: pd.DataFrame) -> pd.DataFrame:
    a, b, c = (table[name].to_numpy() for name in ("axis_a_m", "axis_b_m", "axis_c_m"))
    return table.assign(sphericity_3d=np.cbrt(a * a / (b * c)))
