"""Intraclass correlations: how much of the spread is between rocks rather than between views."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

from validation.statistics.block import Block
from validation.statistics.interval import LEVEL

Interval = tuple[float, float]
_NO_INTERVAL = (math.nan, math.nan)
_TAIL = (1.0 - LEVEL) / 2.0


@dataclass(frozen=True)
class IntraclassCorrelation:
    """ICC(2,1) asks that the values agree, ICC(3,1) only that they agree up to a view's shift."""

    icc_2_1: float
    icc_3_1: float
    rocks: int
    icc_2_1_interval: Interval = _NO_INTERVAL
    icc_3_1_interval: Interval = _NO_INTERVAL


@dataclass(frozen=True)
class _MeanSquares:
    """The two-way analysis of variance of n rocks in k views, pooled over blocks."""

    rocks: float
    views: float
    error: float
    rock_freedom: float
    view_freedom: float
    error_freedom: float
    n: float  # rocks a block, their mean
    k: int

    def consistency(self) -> float:
        """ICC(3,1)."""
        return _ratio(self.rocks - self.error, self.rocks + (self.k - 1) * self.error)

    def agreement(self) -> float:
        """ICC(2,1)."""
        shift = self.k * (self.views - self.error) / self.n
        return _ratio(self.rocks - self.error, self.rocks + (self.k - 1) * self.error + shift)

    def consistency_interval(self) -> Interval:
        """Exact F interval of ICC(3,1) (Shrout and Fleiss 1979)."""
        if self.error <= 0:
            return _NO_INTERVAL
        f = self.rocks / self.error
        low = f / stats.f.isf(_TAIL, self.rock_freedom, self.error_freedom)
        high = f * stats.f.isf(_TAIL, self.error_freedom, self.rock_freedom)
        return (low - 1) / (low + self.k - 1), (high - 1) / (high + self.k - 1)

    def agreement_interval(self) -> Interval:
        """F interval of ICC(2,1) with Satterthwaite's freedom (McGraw and Wong 1996)."""
        rho = self.agreement()
        if self.error <= 0 or not rho < 1:
            return _NO_INTERVAL
        n, k = self.n, self.k
        view_part = k * rho / (n * (1 - rho)) * self.views
        error_part = (1 + k * rho * (n - 1) / (n * (1 - rho))) * self.error
        freedom = _ratio(
            (view_part + error_part) ** 2,
            view_part**2 / self.view_freedom + error_part**2 / self.error_freedom,
        )
        noise = k * self.views + (k * n - k - n) * self.error
        low = stats.f.isf(_TAIL, self.rock_freedom, freedom)
        high = stats.f.isf(_TAIL, freedom, self.rock_freedom)
        ends = (
            _ratio(n * (self.rocks - low * self.error), low * noise + n * self.rocks),
            _ratio(n * (high * self.rocks - self.error), noise + n * high * self.rocks),
        )
        return ends if all(map(math.isfinite, ends)) else _NO_INTERVAL


def _ratio(part: float, whole: float) -> float:
    return part / whole if 0 < whole < math.inf else math.nan


def intraclass_correlation(blocks: Sequence[Block]) -> IntraclassCorrelation:
    """ICC(2,1) and ICC(3,1) of the logarithms of the values (Shrout and Fleiss 1979).

    With n rocks, k views and the two-way mean squares of rocks (MSR), views (MSC) and error (MSE):
    ICC(2,1) = (MSR − MSE)/(MSR + (k − 1) MSE + k (MSC − MSE)/n) and
    ICC(3,1) = (MSR − MSE)/(MSR + (k − 1) MSE). Logarithms make a view that multiplies all values a
    shift. Several blocks pool sums of squares and degrees of freedom, and n is the mean number of
    rocks a block; their number of views must be the same. Rocks that a view lacks are left out.
    NaN when a value is not positive, or with fewer than two rocks or views in every block, or
    when nothing varies.
    """
    nothing = IntraclassCorrelation(math.nan, math.nan, 0)
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
    rocks = sum(table.shape[1] for table in tables)
    mean_squares = squares / freedoms
    found = _MeanSquares(
        rocks=float(mean_squares[0]),
        views=float(mean_squares[1]),
        error=float(mean_squares[2]),
        rock_freedom=float(freedoms[0]),
        view_freedom=float(freedoms[1]),
        error_freedom=float(freedoms[2]),
        n=rocks / len(tables),
        k=k,
    )
    return IntraclassCorrelation(
        icc_2_1=found.agreement(),
        icc_3_1=found.consistency(),
        rocks=rocks,
        icc_2_1_interval=found.agreement_interval(),
        icc_3_1_interval=found.consistency_interval(),
    )
