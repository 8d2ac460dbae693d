"""Scores of hand-drawn shapes in series, as in the paper's figures 8 and 9."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from validation.agreement import Block, tau_b, within_views
from validation.claims import Claim
from validation.naming import title_of_claim, unit_of
from validation.scores.agreement import weighted_mean
from validation.scores.blocks import blocks_of
from validation.scores.score import Better, Definition, Estimate, Key


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


def _level(blocks: Sequence[Block]) -> Estimate:
    return weighted_mean(np.concatenate([np.empty(0), *(_series(block) for block in blocks)]))


@dataclass(frozen=True)
class _Statistic:
    key: str
    title: str
    unit: str  # empty for the measure's own
    counted: str
    better: Better
    compute: Callable[[Sequence[Block]], Estimate]


_ANY = (
    _Statistic("tau", "order of a drawing's shapes (Kendall's τ_b)", "1", "pairs", "higher", _tau),
    _Statistic(
        "gap_error",
        "gaps between neighbours, RMS from the true gaps",
        "share of the way",
        "gaps",
        "lower",
        _gap_error,
    ),
    _Statistic("level", "mean value", "", "shapes", "neither", _level),
)
_ERROR = _Statistic("error", "RMS difference from the true value", "1", "shapes", "lower", _error)


def _definition(claim: Claim, statistic: _Statistic) -> Definition:
    return Definition(
        key=Key(claim.experiment, claim.method, claim.series, claim.measure, statistic.key),
        title=f"{title_of_claim(claim)}: {statistic.title}",
        unit=statistic.unit or unit_of(claim.measure) or "1",
        counted=statistic.counted,
        better=statistic.better,
        compute=lambda records: statistic.compute(blocks_of(records, claim)),
    )


def definitions(claims: Sequence[Claim]) -> tuple[Definition, ...]:
    """Return the scores of one experiment's claims; an error only where it has a meaning."""
    return tuple(
        _definition(claim, statistic)
        for claim in claims
        for statistic in (*_ANY, *((_ERROR,) if claim.same_quantity else ()))
    )
