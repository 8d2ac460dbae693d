"""Scores of rocks seen from several views."""

from collections.abc import Callable

import pandas as pd

from validation.claims import YARD_CLAIMS, Claim
from validation.naming import title_of
from validation.scores import detection
from validation.scores.agreement import STATISTICS, Statistic
from validation.scores.blocks import blocks_of
from validation.scores.score import Definition, Estimate
from validation.suite import YardExperiment

_DETECTION = (
    ("recall", "rocks found", "share", "rocks in views", detection.recall),
    ("precision", "found rocks that are rocks", "share", "found rocks", detection.precision),
    ("mean_iou", "overlap of the found masks (mean IoU)", "1", "found rocks", detection.mean_iou),
)


def _own(
    experiment: str, compute: Callable[[pd.DataFrame], Estimate]
) -> Callable[[pd.DataFrame], Estimate]:
    return lambda records: compute(records[records["experiment"] == experiment])


def _agreement(experiment: str, claim: Claim, statistic: Statistic) -> Definition:
    return Definition(
        name=f"{experiment}.{claim.measure}.{statistic.key}",
        title=f"{title_of(claim.measure)}: {statistic.title}",
        unit=statistic.unit,
        counted=statistic.counted,
        compute=_own(experiment, lambda records: statistic.compute(blocks_of(records, claim))),
    )


def definitions(experiment: YardExperiment) -> tuple[Definition, ...]:
    """Return the scores of one experiment: detection, then eight statistics for each claim."""
    detected = [
        Definition(f"{experiment.name}.{key}", title, unit, counted, _own(experiment.name, compute))
        for key, title, unit, counted, compute in _DETECTION
    ]
    ranked = [
        _agreement(experiment.name, claim, statistic)
        for varied in experiment.varied
        for claim in YARD_CLAIMS[varied]
        for statistic in STATISTICS
    ]
    return (*detected, *ranked)
