"""Claims and scores of hand-drawn shapes in series, as in the paper's figures 8 and 9."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from validation.kinds.shapes.spec import ShapeSeries, ShapesExperiment
from validation.peers import MeasureSpec, Trait
from validation.scores.agreement import Statistic, tau, weighted_mean
from validation.scores.define import define
from validation.scores.expectations import Claim, JudgedColumn, columns_of, rock_claim
from validation.scores.score import Definition, Estimate
from validation.selfcheck.feeds import CLAIMED as FEEDS
from validation.statistics import Block, within_views

__all__ = ["FEEDS", "claims", "definitions", "gap_shares", "ranked_claims", "view_claims"]

_TRAITS: dict[ShapeSeries, tuple[Trait, ...]] = {
    "roundness": ("angularity", "roundness"),
    "rough": ("angularity", "roundness"),
    "rippled": ("roughness",),
    "sphericity": ("form",),
}
_OUTLINE = "outline_"  # names of an outline's truths where a solid has its own
_FORMS = ("axis_ratio", "rectangle_ratio")  # truths of a drawn shape's form, the usual one first


def gap_shares(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Steps between neighbours of a series as shares of the whole way.

    (x_{i+1} − x_i)/(x_n − x_1), shape (n − 1,), sum 1; negative where the series turns back. NaN
    when first and last are equal.
    """
    way = float(values[-1] - values[0])
    shares: NDArray[np.float64] = np.diff(values) / (way if way != 0 else np.nan)
    return shares


def _series(block: Block) -> NDArray[np.float64]:
    values: NDArray[np.float64] = block.values[0]
    return values


def _gap_error(blocks: Sequence[Block]) -> Estimate:
    """RMS difference between the measured and the true shares of the gaps."""
    errors = np.concatenate(
        [np.empty(0), *(gap_shares(_series(b)) - gap_shares(b.truth) for b in blocks)]
    )
    value = float(np.sqrt((errors**2).mean())) if errors.size else float("nan")
    return Estimate(value, int(errors.size))


def _error(blocks: Sequence[Block]) -> Estimate:
    """RMS difference between measure and truth, which must have one unit."""
    errors = np.concatenate([np.empty(0), *(_series(b) - b.truth for b in blocks)])
    value = float(np.sqrt((errors**2).mean())) if errors.size else float("nan")
    return Estimate(value, int(errors.size))


def _level(blocks: Sequence[Block]) -> Estimate:
    return weighted_mean(np.concatenate([np.empty(0), *(_series(block) for block in blocks)]))


_ANY = (
    Statistic(
        "tau",
        "order of a drawing's shapes (Kendall's τ_b)",
        "1",
        "pairs",
        "higher",
        lambda blocks: tau(within_views(blocks)),
    ),
    Statistic(
        "gap_error",
        "gaps between neighbours, RMS from the true gaps",
        "share of the way",
        "gaps",
        "lower",
        _gap_error,
    ),
    Statistic("level", "mean value", "", "shapes", "neither", _level),
)
_ERROR = Statistic("error", "RMS difference from the true value", "1", "shapes", "lower", _error)


def _claim(experiment: ShapesExperiment, series: str, column: JudgedColumn) -> Claim:
    """Claim on a column: a drawn shape's truths are those of its outline."""
    equals = "" if column.measure is None else column.measure.equals
    truth: str = column.trait
    if column.trait == "form":
        truth = next((form for form in _FORMS if _OUTLINE + form == equals), _FORMS[0])
    same = _OUTLINE + truth == equals
    return rock_claim(experiment.name, series, column, truth=truth, same_quantity=same)


def claims(experiment: ShapesExperiment, measures: Sequence[MeasureSpec]) -> tuple[Claim, ...]:
    """Claims of measures that need no range, by series, then by method."""
    columns = [
        column
        for column in columns_of(experiment, measures)
        if column.measure is None or not column.measure.needs_range
    ]
    return tuple(
        _claim(experiment, series, column)
        for series in experiment.series
        for column in columns
        if column.trait in _TRAITS[series]
    )


ranked_claims = claims


def view_claims(
    _experiment: ShapesExperiment,
    _measures: Sequence[MeasureSpec],
) -> tuple[Claim, ...]:
    """None: a drawing has one view, and its truths are what it shows."""
    return ()


def definitions(
    experiment: ShapesExperiment, measures: Sequence[MeasureSpec]
) -> tuple[Definition, ...]:
    """Scores of one experiment's claims; an error only where it has a meaning."""
    return tuple(
        define(claim, statistic)
        for claim in claims(experiment, measures)
        for statistic in (*_ANY, *((_ERROR,) if claim.same_quantity else ()))
    )
