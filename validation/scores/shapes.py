"""Scores of hand-drawn shapes in series, as in the paper's figures 8 and 9."""

from collections.abc import Callable, Sequence

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.agreement import Block, tau_b, within_views
from validation.claims import SHAPES_CLAIMS, Claim
from validation.naming import title_of
from validation.scores.blocks import blocks_of
from validation.scores.score import Definition, Estimate
from validation.suite import ShapesExperiment


def gap_shares(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the steps between neighbours of a series as shares of the whole way.

    (x_{i+1} − x_i)/(x_n − x_1), shape (n − 1,), sum 1; negative where the series turns back. NaN
    when first and last are equal.
    """
    way = float(values[-1] - values[0])
    shares: NDArray[np.float64] = np.diff(values) / (way if way != 0 else np.nan)
    return shares


def _series(block: Block) -> NDArray[np.float64]:
    values: NDArray[np.float64] = block.values[0]
    return values


def _tau(blocks: Sequence[Block]) -> Estimate:
    pairs = within_views(blocks)
    return Estimate(tau_b(pairs), pairs.decided, pairs.rocks, lambda w: tau_b(pairs, w))


def _gap_error(blocks: Sequence[Block]) -> Estimate:
    """Return the RMS difference between the measured and the true shares of the gaps."""
    errors = np.concatenate(
        [np.empty(0), *(gap_shares(_series(b)) - gap_shares(b.truth) for b in blocks)]
    )
    value = float(np.sqrt((errors**2).mean())) if errors.size else float("nan")
    return Estimate(value, int(errors.size))


def _error(blocks: Sequence[Block]) -> Estimate:
    """Return the RMS difference between measure and truth, which must have one unit."""
    errors = np.concatenate([np.empty(0), *(_series(b) - b.truth for b in blocks)])
    value = float(np.sqrt((errors**2).mean())) if errors.size else float("nan")
    return Estimate(value, int(errors.size))


_Statistic = tuple[str, str, str, str, Callable[[Sequence[Block]], Estimate]]
_ORDER: _Statistic = ("tau", "order of a drawing's shapes (Kendall's τ_b)", "1", "pairs", _tau)
_GAPS: _Statistic = (
    "gap_error",
    "gaps between neighbours, RMS from the true gaps",
    "share of the way",
    "gaps",
    _gap_error,
)
_ERROR: _Statistic = ("error", "RMS difference from the true ratio", "1", "shapes", _error)
# Angularity has no unit in common with its truth, a ratio has.
_BY_SERIES: dict[str, tuple[_Statistic, ...]] = {
    "roundness": (_ORDER, _GAPS),
    "sphericity": (_ORDER, _GAPS, _ERROR),
}


def _definition(
    experiment: ShapesExperiment, series: str, claim: Claim, statistic: _Statistic
) -> Definition:
    key, title, unit, counted, compute = statistic

    def of_series(records: pd.DataFrame) -> Estimate:
        own = (records["experiment"] == experiment.name) & (records["series"] == series)
        return compute(blocks_of(records[own], claim))

    return Definition(
        name=f"{experiment.name}.{series}.{claim.measure}.{key}",
        title=f"{title_of(claim.measure)}: {title}",
        unit=unit,
        counted=counted,
        compute=of_series,
    )


def definitions(experiment: ShapesExperiment) -> tuple[Definition, ...]:
    """Return the scores of one experiment, series by series and measure by measure."""
    return tuple(
        _definition(experiment, series, claim, statistic)
        for series in experiment.series
        for claim in SHAPES_CLAIMS[series]
        for statistic in _BY_SERIES[series]
    )
