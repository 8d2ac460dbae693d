"""How far a rock's rank is from the true one: within its view, and among all of its experiment."""

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.scores.expectations import Claim


def usable(records: pd.DataFrame, claim: Claim) -> pd.DataFrame:
    """Records that a claim is judged on: eligible, measured, and with truth."""
    own = records["experiment"].eq(claim.experiment) & records["method"].eq(claim.method)
    own &= records["series"].eq(claim.series) & records["eligible"].astype(bool)
    held = records[own]
    finite = np.isfinite(held[claim.measure].to_numpy(dtype=np.float64))
    finite &= np.isfinite(held[claim.truth].to_numpy(dtype=np.float64))
    found: pd.DataFrame = held[finite]
    return found


def ranks_off(records: pd.DataFrame, claim: Claim) -> dict[int, int]:
    """By how many ranks each usable record is off within its view, by its index."""
    own = usable(records, claim)
    views = own.groupby(["scene", "view"])
    off = (views[claim.measure].rank() - views[claim.truth].rank()).abs()
    return dict(zip(off.index.tolist(), off.astype(int).tolist(), strict=True))


def farthest(records: pd.DataFrame, claim: Claim, count: int) -> NDArray[np.intp]:
    """Index of the records whose rank among all is farthest from their true one."""
    own = usable(records, claim)
    gap = (own[claim.measure].rank(pct=True) - own[claim.truth].rank(pct=True)).abs()
    order = np.argsort(-gap.to_numpy(), kind="stable")[:count]
    return own.index.to_numpy()[order]
