"""Kendall's coefficient of concordance W: whether the views rank the rocks alike."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from validation.agreement.block import Block


def _tie_sum(values: NDArray[np.float64]) -> float:
    """Return Σ (t³ − t) over the groups of t equal values of one view."""
    sizes = np.unique(values, return_counts=True)[1].astype(np.float64)
    return float((sizes**3 - sizes).sum())


def kendall_w(blocks: Sequence[Block]) -> float:
    """Return Kendall's W with the correction for ties.

    W = 12 S / (m² (n³ − n) − m Σ T), with m views, n rocks, S the squared deviations of the rank
    sums and T = Σ (t³ − t) over the ties of a view (Kendall and Babington Smith 1939). For several
    blocks numerators and denominators are summed. Only rocks measured in every view count; a
    block with fewer than two such rocks or two views adds nothing, and NaN is returned when none
    does or when every view ties all rocks.
    """
    numerator = denominator = 0.0
    for block in blocks:
        values = block.complete()
        m, n = values.shape
        if m < 2 or n < 2:
            continue
        sums = stats.rankdata(values, axis=1).sum(axis=0)
        numerator += 12.0 * float(((sums - sums.mean()) ** 2).sum())
        denominator += m**2 * (n**3 - n) - m * sum(_tie_sum(view) for view in values)
    return numerator / denominator if denominator > 0 else float("nan")
