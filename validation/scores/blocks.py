"""Records as blocks (views, rocks) of one measure, one block a scene."""

import numpy as np
import pandas as pd

from validation.agreement import Block
from validation.claims import Claim


def blocks_of(records: pd.DataFrame, claim: Claim) -> tuple[Block, ...]:
    """Return a block for each scene of the records (of one experiment and one series).

    Only rocks that the view shows well enough (`eligible`) count; a rock that was not found, or
    whose measure is NaN, is NaN. Rocks without the truth in question are left out.
    """
    true_rows = records[records["status"] != "extra"]
    blocks = []
    for _, scene in true_rows.groupby("scene", sort=True):
        measured = scene[claim.measure].astype(np.float64).where(scene["eligible"].astype(bool))
        table = scene.assign(value=measured).pivot(index="view", columns="instance", values="value")
        truth = scene.drop_duplicates("instance").set_index("instance")[claim.truth]
        known = truth.reindex(table.columns).to_numpy(dtype=np.float64)
        keep = np.isfinite(known)
        blocks.append(Block(values=table.to_numpy(dtype=np.float64)[:, keep], truth=known[keep]))
    return tuple(blocks)
