"""Intraclass correlations: how much of the spread is between rocks rather than between views."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from validation.agreement.block import Block


@dataclass(frozen=True)
class IntraclassCorrelation:
    """ICC(2,1) asks that the values agree, ICC(3,1) only that they agree up to a view's shift."""

    icc_2_1: float
    icc_3_1: float
    rocks: int


def intraclass_correlation(blocks: Sequence[Block]) -> IntraclassCorrelation:
    """Return ICC(2,1) and ICC(3,1) of the logarithms of the values (Shrout and Fleiss 1979).

    With n rocks, k views and the two-way mean squares of rocks (MSR), views (MSC) and error (MSE):
    ICC(2,1) = (MSR − MSE)/(MSR + (k − 1) MSE + k (MSC − MSE)/n) and
    ICC(3,1) = (MSR − MSE)/(MSR + (k − 1) MSE). Logarithms make a view that multiplies all values a
    shift. Several blocks pool sums of squares and degrees of freedom, and n is the mean number of
    rocks a block; their number of views must be the same. Rocks that a view lacks are left out.
    NaN when a value is not positive, or with fewer than two rocks or views in every block, or
    when nothing varies.
    """
    nothing = IntraclassCorrelation(float("nan"), float("nan"), 0)
    tables = [t for t in (block.complete() for block in blocks) if min(t.shape) >= 2]
    if not tables or any((table <= 0).any() for table in tables):
        return nothing
    k = tables[0].shape[0]
    if any(table.shape[0] != k for table in tables):
        return nothing
    squares, freedoms = np.zeros(3), np.zeros(3)  # rocks, views, error
    for table in tables:
        logs = np.log(table)
        n = logs.shape[1]
        rock_shift = logs.mean(axis=0) - logs.mean()
        view_shift = logs.mean(axis=1, keepdims=True) - logs.mean()
        rest = logs - logs.mean() - rock_shift - view_shift
        squares += [k * (rock_shift**2).sum(), n * (view_shift**2).sum(), (rest**2).sum()]
        freedoms += [n - 1, k - 1, (n - 1) * (k - 1)]
    msr, msc, mse = squares / freedoms
    rocks = sum(table.shape[1] for table in tables)
    consistent = msr + (k - 1) * mse
    absolute = consistent + k * (msc - mse) / (rocks / len(tables))
    return IntraclassCorrelation(
        icc_2_1=float((msr - mse) / absolute) if absolute > 0 else float("nan"),
        icc_3_1=float((msr - mse) / consistent) if consistent > 0 else float("nan"),
        rocks=rocks,
    )
