"""Scores of rocks seen from several views."""

from collections.abc import Callable, Sequence

import pandas as pd

from validation.claims import Claim
from validation.naming import REFERENCE, title_of_claim, unit_of
from validation.scores import detection, levels
from validation.scores.agreement import STATISTICS, Statistic
from validation.scores.blocks import blocks_of
from validation.scores.score import Better, Definition, Estimate, Key
from validation.suite import YardExperiment

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


def _own(experiment: str, method: str, compute: _Compute) -> _Compute:
    return lambda records: compute(
        records[(records["experiment"] == experiment) & (records["method"] == method)]
    )


def _of_method(experiment: YardExperiment, method: str) -> list[Definition]:
    suffix = "" if method == REFERENCE else f" ({method})"
    return [
        Definition(
            key=Key(experiment.name, method, "", "", key),
            title=title + suffix,
            unit=unit,
            counted=counted,
            better=better,
            compute=_own(experiment.name, method, compute),
        )
        for key, title, unit, counted, better, compute in _OF_METHOD
    ]


def _of_claim(claim: Claim, statistic: Statistic) -> Definition:
    return Definition(
        key=Key(claim.experiment, claim.method, "", claim.measure, statistic.key),
        title=f"{title_of_claim(claim)}: {statistic.title}",
        unit=statistic.unit or unit_of(claim.measure) or "1",
        counted=statistic.counted,
        better=statistic.better,
        compute=lambda records: statistic.compute(blocks_of(records, claim)),
    )


def definitions(experiment: YardExperiment, claims: Sequence[Claim]) -> tuple[Definition, ...]:
    """Return the scores of one experiment: what each method found, then each claim's statistics."""
    found = [d for method in experiment.methods for d in _of_method(experiment, method)]
    ranked = [_of_claim(claim, s) for claim in claims for s in (*STATISTICS, *levels.of(claim))]
    return (*found, *ranked)
