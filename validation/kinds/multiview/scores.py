"""Scores of rocks seen from several views."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import pandas as pd

from validation.kinds.multiview import detection, levels
from validation.scores.agreement import ORDERS, STATISTICS, Statistic
from validation.scores.define import define
from validation.scores.expectations import Claim
from validation.scores.score import Better, Definition, Estimate, Key
from validation.scores.titles import REFERENCE
from validation.suite.experiments import YardExperiment

VIEW_PREFIX = "view_"  # of statistics against the outline that a view shows

_Compute = Callable[[pd.DataFrame], Estimate]
_OF_METHOD: tuple[tuple[str, str, str, str, Better, _Compute], ...] = (
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
)


def _own(key: Key, compute: _Compute) -> _Compute:
    return lambda records: compute(
        records[
            (records["experiment"] == key.experiment)
            & (records["series"] == key.series)
            & (records["method"] == key.method)
        ]
    )


def _of_method(experiment: YardExperiment, series: str, method: str) -> list[Definition]:
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
        for statistic, title, unit, counted, better, compute in _OF_METHOD
    ]


def _of_view(statistic: Statistic) -> Statistic:
    """Return a statistic of what each view truly shows under a name of its own."""
    return replace(
        statistic,
        key=VIEW_PREFIX + statistic.key,
        title=f"{statistic.title}, by the outline that the view shows",
    )


def definitions(
    experiment: YardExperiment, claims: Sequence[Claim], view_claims: Sequence[Claim]
) -> tuple[Definition, ...]:
    """Return the scores of one experiment: what each method found, then each claim's statistics."""
    found = [
        definition
        for series in experiment.series
        for method in experiment.methods
        for definition in _of_method(experiment, series, method)
    ]
    ranked = [define(claim, s) for claim in claims for s in (*STATISTICS, *levels.of(claim))]
    shown = [
        define(claim, _of_view(statistic))
        for claim in view_claims
        for statistic in (*ORDERS, *(levels.DIFFERENCES if claim.same_quantity else ()))
    ]
    return (*found, *ranked, *shown)
