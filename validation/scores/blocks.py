"""Records as blocks (views, rocks) of one measure, one block a scene."""

import numpy as np
import pandas as pd

from validation.scores.expectations import Claim
from validation.statistics import Block


def blocks_of(records: pd.DataFrame, claim: Claim) -> tuple[Block, ...]:
    """Block for each scene of the claim's experiment, series and method.

    Only rocks that the view shows well enough (`eligible`) count; a rock that was not found, or
    whose measure is NaN, is NaN. Rocks without the truth in question are left out. The truth is
    (rocks,), or (views, rocks) for a claim on what each view shows.
    """
    own = records[
        (records["experiment"] == claim.experiment)
        & (records["series"] == claim.series)
        & (records["method"] == claim.method)
    ]
    rows = own[own["status"] != "extra"].sort_values("scene", kind="stable")
    scene, view, instance = (
        rows[name].to_numpy(dtype=np.int64) for name in ("scene", "view", "instance")
    )
    measured = rows[claim.measure].to_numpy(dtype=np.float64)
    value = np.where(rows["eligible"].to_numpy(dtype=bool), measured, np.nan)
    truth = rows[claim.truth].to_numpy(dtype=np.float64)
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
