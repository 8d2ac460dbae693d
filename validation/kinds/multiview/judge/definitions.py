"""Claims and scores of rocks seen from several views."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import pandas as pd

from rockshape.method import find_method
from validation.kinds.multiview.judge import detection, levels
from validation.kinds.multiview.spec import MultiviewExperiment, Varied
from validation.peers import MeasureSpec, Trait
from validation.scores.agreement import ORDERS, STATISTICS, Statistic, tau
from validation.scores.blocks import pooled_block
from validation.scores.define import define
from validation.scores.expectations import TRUTH, Claim, JudgedColumn, columns_of, rock_claim
from validation.scores.score import VIEW_PREFIX, Better, Definition, Estimate, Key
from validation.scores.titles import REFERENCE, title_of_claim
from validation.statistics import across_views

# The traits that differ between rocks where an experiment varies one: roundness is the reverse of
# angularity, whose truth is 1 − roundness.
_TRAITS: dict[Varied, tuple[Trait, ...]] = {
    "angularity": ("angularity", "roundness"),
    "roughness": ("roughness",),
    "form": ("form",),
}
_FORM = "maximum_projection_sphericity"  # truth of a solid's form

_Compute = Callable[[pd.DataFrame], Estimate]
_Row = tuple[str, str, str, str, Better, _Compute]
_OF_METHOD: tuple[_Row, ...] = (
    ("recall", "rocks found", "share", "rocks in views", "higher", detection.recall),
    (
        "precision",
        "found rocks that are rocks",
        "share",
        "found rocks",
        "higher",
        detection.precision,
    ),
    (
        "mean_iou",
        "overlap of the found masks (mean IoU)",
        "1",
        "found rocks",
        "higher",
        detection.mean_iou,
    ),
    (
        "centre_px",
        "measured centre from the true mask's, RMS",
        "px",
        "found rocks",
        "lower",
        levels.centre_px,
    ),
    (
        "axis_a",
        "measured over true longest half-axis, median",
        "1",
        "found rocks",
        "neither",
        levels.axis_a,
    ),
    (
        "axes_error",
        "mean absolute relative error of the half-axes",
        "share",
        "half-axes",
        "lower",
        levels.axes_error,
    ),
)


def _own(key: Key, compute: _Compute) -> _Compute:
    return lambda records: compute(
        records[
            (records["experiment"] == key.experiment)
            & (records["series"] == key.series)
            & (records["method"] == key.method)
        ]
    )


def _refused(method: str) -> _Row:
    """Share of the method's measures that have no value, where rocks are large enough."""
    columns = [measure.column for measure in find_method(method).measures]
    return (
        "refused",
        f"values refused, of rocks in plain view {levels.LARGE_PX:g} px across and more",
        "share",
        "found rocks",
        "lower",
        partial(levels.refused, columns=columns),
    )


def _of_method(experiment: MultiviewExperiment, series: str, method: str) -> list[Definition]:
    suffix = "" if method == REFERENCE else f" ({method})"
    return [
        Definition(
            key=(key := Key(experiment.name, method, series, "", statistic)),
            title=title + suffix,
            unit=unit,
            counted=counted,
            better=better,
            compute=_own(key, compute),
        )
        for statistic, title, unit, counted, better, compute in (*_OF_METHOD, _refused(method))
    ]


def _answered(claim: Claim) -> Definition:
    """Share of the found rocks that have a value, without which the other scores say little."""
    key = Key(claim.experiment, claim.method, claim.series, claim.measure, "answered")
    return Definition(
        key=key,
        title=f"{title_of_claim(claim)}: found rocks that have a value",
        unit="share",
        counted="found rocks",
        better="higher",
        compute=_own(key, partial(levels.answered, column=claim.measure)),
    )


def _over_steps(claim: Claim, steps: Sequence[str]) -> Definition:
    """Order of all rock views of a sweep."""
    whole = replace(claim, series="")
    return Definition(
        key=Key(claim.experiment, claim.method, "", claim.measure, "pooled_tau"),
        title=f"{title_of_claim(claim)}: order over all scenes, views and steps (τ_b)",
        unit="1",
        counted="pairs",
        better="higher",
        compute=lambda records: tau(across_views(pooled_block(records, whole, steps))),
    )


def _of_view(statistic: Statistic) -> Statistic:
    """Statistic of what each view truly shows under a name of its own."""
    return replace(
        statistic,
        key=VIEW_PREFIX + statistic.key,
        title=f"{statistic.title}, by the outline that the view shows",
    )


def _of_rock(experiment: MultiviewExperiment, series: str, column: JudgedColumn) -> Claim:
    """Claim held to the solid's own truth, which no measure of an outline can equal."""
    truth = _FORM if column.trait == "form" else column.trait
    same = column.measure is not None and truth == column.measure.equals
    return rock_claim(experiment.name, series, column, truth=truth, same_quantity=same)


def claims(experiment: MultiviewExperiment, measures: Sequence[MeasureSpec]) -> tuple[Claim, ...]:
    """Claims that the rocks can judge, by what varies between them, then by method."""
    columns = list(columns_of(experiment, measures))
    return tuple(
        _of_rock(experiment, series, column)
        for series in experiment.series
        for varied in experiment.varied
        for column in columns
        if column.trait in _TRAITS[varied]
    )


def view_claims(
    experiment: MultiviewExperiment, measures: Sequence[MeasureSpec]
) -> tuple[Claim, ...]:
    """Claims on what each view truly shows."""
    return tuple(
        Claim(
            experiment.name,
            series,
            column.method,
            column.name,
            TRUTH + column.measure.view_truth,
            per_view=True,
            same_quantity=column.measure.view_truth == column.measure.equals,
        )
        for series in experiment.series
        for column in columns_of(experiment, measures)
        if column.measure is not None and column.measure.view_truth
    )


def ranked_claims(
    experiment: MultiviewExperiment, measures: Sequence[MeasureSpec]
) -> tuple[Claim, ...]:
    """Claims that the leaderboard ranks: a sweep's charts show its own."""
    return claims(experiment, measures) if experiment.sweep is None else ()


def definitions(
    experiment: MultiviewExperiment, measures: Sequence[MeasureSpec]
) -> tuple[Definition, ...]:
    """Scores of one experiment: what each method found, then each claim's statistics."""
    found = [
        definition
        for series in experiment.series
        for method in experiment.methods
        for definition in _of_method(experiment, series, method)
    ]
    of_rocks = claims(experiment, measures)
    ranked = [
        define(claim, statistic)
        for claim in of_rocks
        for statistic in (*STATISTICS, *levels.of(claim))
    ]
    valued = [_answered(claim) for claim in of_rocks]
    pooled = [
        _over_steps(claim, experiment.series)
        for claim in of_rocks
        if experiment.sweep is not None and claim.series == experiment.series[0]
    ]
    shown = [
        define(claim, _of_view(statistic))
        for claim in view_claims(experiment, measures)
        for statistic in (*ORDERS, *(levels.DIFFERENCES if claim.same_quantity else ()))
    ]
    return (*found, *ranked, *valued, *pooled, *shown)
