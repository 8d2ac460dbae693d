"""A claim's score by one statistic, the same for rocks and for drawn shapes."""

from validation.scores.agreement import Statistic
from validation.scores.blocks import blocks_of
from validation.scores.expectations import Claim
from validation.scores.score import Definition, Key
from validation.scores.titles import title_of_claim, unit_of


def define(claim: Claim, statistic: Statistic) -> Definition:
    """Score of a claim's blocks; a statistic without a unit has the measure's."""
    return Definition(
        key=Key(claim.experiment, claim.method, claim.series, claim.measure, statistic.key),
        title=f"{title_of_claim(claim)}: {statistic.title}",
        unit=statistic.unit or unit_of(claim.measure) or "1",
        counted=statistic.counted,
        better=statistic.better,
        compute=lambda records: statistic.compute(blocks_of(records, claim)),
    )
