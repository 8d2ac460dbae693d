"""Score of one finder in one experiment, before both are named."""

from dataclasses import dataclass

from validation.scores.object_scores import Compute
from validation.scores.score import Better

BLOCK = ("scene", "view")  # what is drawn for intervals: blocks of pictures
PICTURE = ("scene",)


@dataclass(frozen=True)
class ScoreOf:
    """Statistic of the records of one experiment and series."""

    statistic: str
    title: str
    unit: str
    counted: str
    better: Better
    compute: Compute
    measure: str = ""  # quantity that it is of
