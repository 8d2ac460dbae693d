"""Judge of fused experiments: form against the truth, of each view alone and of views as one."""

from collections.abc import Sequence
from dataclasses import replace

import pandas as pd

from rockshape.method import find_method
from validation.arrays import Floats
from validation.kinds.fused.spec import ALONE, FUSED, SERIES, FusedExperiment
from validation.kinds.multiview.judge.detection import recall
from validation.kinds.multiview.judge.levels import DIFFERENCES
from validation.peers import MeasureSpec
from validation.scores.agreement import ORDERS
from validation.scores.blocks import blocks_of
from validation.scores.define import define
from validation.scores.expectations import TRUTH, Claim
from validation.scores.score import Definition, Estimate, Key
from validation.scores.titles import title_of_claim
from validation.selfcheck.feeds import CLAIMED as FEEDS

__all__ = ["FEEDS", "claims", "definitions", "ranked_claims", "view_claims"]

FORM = "maximum_projection_sphericity"
_TAU = tuple(statistic for statistic in ORDERS if statistic.key == "tau")
(_ERROR,) = (statistic for statistic in DIFFERENCES if statistic.key == "error")


def claims(
    experiment: FusedExperiment,
    _measures: Sequence[MeasureSpec],
) -> tuple[Claim, ...]:
    """Claims of the measures of form, of each view alone and under each kind of pose."""
    return tuple(
        Claim(experiment.name, series, method, measure.column, TRUTH + FORM, same_quantity=True)
        for series in SERIES
        for method in experiment.methods
        for measure in find_method(method).measures
        if measure.equals == FORM
    )


def view_claims(
    _experiment: FusedExperiment,
    _measures: Sequence[MeasureSpec],
) -> tuple[Claim, ...]:
    """None: views that are one show no outline."""
    return ()


ranked_claims = view_claims


def definitions(
    experiment: FusedExperiment, measures: Sequence[MeasureSpec]
) -> tuple[Definition, ...]:
    """Share of rocks matched, and of each claim its order and its differences from the truth.

    Of views as one, also how much nearer to the truth they are than the views alone.
    """
    matched = [
        _matched(Key(experiment.name, method, series, "", "matched"))
        for series in FUSED
        for method in experiment.methods
    ]
    held = claims(experiment, measures)
    form = [define(claim, statistic) for claim in held for statistic in (*_TAU, *DIFFERENCES)]
    gains = [_gain(claim, replace(claim, series=ALONE)) for claim in held if claim.series in FUSED]
    return (*matched, *form, *gains)


def _gain(fused: Claim, alone: Claim) -> Definition:
    def compute(records: pd.DataFrame) -> Estimate:
        together, apart = (_ERROR.compute(blocks_of(records, each)) for each in (fused, alone))
        if together.weighted is None or apart.weighted is None:
            return Estimate(float("nan"), together.count)
        both = (apart.weighted, together.weighted)  # of the same rocks

        def gain(weights: Floats) -> Floats:
            return both[0](weights) - both[1](weights)

        return Estimate(apart.value - together.value, together.count, together.rocks, gain)

    return Definition(
        key=Key(fused.experiment, fused.method, fused.series, fused.measure, "gain"),
        title=f"{title_of_claim(fused)}: RMS difference of views alone less that of views as one",
        unit="1",
        counted="rocks",
        better="higher",
        compute=compute,
    )


def _matched(key: Key) -> Definition:
    def compute(records: pd.DataFrame) -> Estimate:
        own = (records["experiment"] == key.experiment) & (records["method"] == key.method)
        return recall(records[own & (records["series"] == key.series)])

    return Definition(
        key=key,
        title=f"{key.series} poses ({key.method}): rocks with all their views as one",
        unit="share",
        counted="rocks",
        better="higher",
        compute=compute,
    )
