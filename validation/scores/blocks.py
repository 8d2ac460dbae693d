"""Records as blocks (views, rocks) of one measure, one block a scene."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.scores.expectations import Claim
from validation.statistics import Block


def blocks_of(records: pd.DataFrame, claim: Claim) -> tuple[Block, ...]:
    """Block for each scene of the claim's experiment, series and method.

    Only rocks that the view shows well enough (`eligible`) count; a rock that was not found, or
    whose measure is NaN, is NaN. Rocks without the truth in question are left out. The truth is
    (rocks,), or (views, rocks) for a claim on what each view shows.
    """

    def column(name: str) -> NDArray[Any]:
        return records[name].to_numpy()

    own = np.flatnonzero(
        (column("experiment") == claim.experiment)
        & (column("series") == claim.series)
        & (column("method") == claim.method)
        & (column("status") != "extra")
    )
    own = own[np.argsort(column("scene")[own], kind="stable")]
    scene, view, instance = (
        column(name)[own].astype(np.int64) for name in ("scene", "view", "instance")
    )
    measured = column(claim.measure)[own].astype(np.float64)
    value = np.where(column("eligible")[own].astype(bool), measured, np.nan)
    truth = column(claim.truth)[own].astype(np.float64)
    starts = np.flatnonzero(np.diff(scene, prepend=-1))
    blocks = []
    for part in np.split(np.arange(scene.size), starts[1:]) if scene.size else ():
        views, view_index = np.unique(view[part], return_inverse=True)
        rocks, rock_index = np.unique(instance[part], return_inverse=True)
        table = np.full((views.size, rocks.size), np.nan)
        table[view_index, rock_index] = value[part]
        if claim.per_view:
            seen = np.full_like(table, np.nan)
            seen[view_index, rock_index] = truth[part]
            blocks.append(Block(values=table, truth=seen))
            continue
        known = np.empty(rocks.size)
        known[rock_index] = truth[part]
        keep = np.isfinite(known)
        blocks.append(Block(values=table[:, keep], truth=known[keep]))
    return tuple(blocks)


def pooled_block(records: pd.DataFrame, claim: Claim, series: Sequence[str]) -> tuple[Block, ...]:
    """Block of the rocks of all scenes, seen in the views of several series; none without any.

    The series are steps of a sweep; a rock's truth may differ between them.
    """
    own = records[
        (records["experiment"] == claim.experiment)
        & records["series"].isin(series)
        & (records["status"] != "extra")
    ]
    return blocks_of(
        own.assign(
            scene=0,
            instance=own.groupby(["scene", "instance"]).ngroup(),
            view=own.groupby(["series", "view"]).ngroup(),
            series=claim.series,
        ),
        replace(claim, per_view=True),
    )
