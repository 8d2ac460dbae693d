"""What a measure is: one number for one rock, with a name and a unit, or the reason for none."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from rockshape.rock.view import RockView


class Reason(StrEnum):
    """Why a rock has no value of a measure."""

    NO_RANGE = "no range"
    TOO_SMALL = "too small"
    TRUNCATED = "truncated"
    DEGENERATE = "degenerate"
    NOT_RESOLVABLE = "not resolvable"


@dataclass(frozen=True)
class Reading:
    """What a measure says of one rock: a finite value, or NaN and the reason for it."""

    value: float
    reason: Reason | None = None


@dataclass(frozen=True)
class Measure:
    """A column of the table and the function that fills it.

    The function returns NaN, or the Reason if it knows one, for a rock it cannot measure.
    """

    column: str
    title: str  # the field's term
    paper_name: str  # what Fox et al. (2002) call it; empty where they have no such measure
    unit: str  # empty for a pure number
    needs_range: bool
    fewest: int  # outline points, or range points where it needs range, below which it is NaN
    evaluate: Callable[[RockView], float | Reason]
    whole: bool = False  # refuses a rock that the frame has cut

    def read(self, rock: RockView) -> Reading:
        """Measure a rock.

        NaN without a reason of its own is `no range` where range is needed and no point has it,
        `too small` under the fewest points, and `degenerate` else.
        """
        if self.whole and rock.truncated:
            return Reading(float("nan"), Reason.TRUNCATED)
        found = self.evaluate(rock)
        if isinstance(found, Reason):
            return Reading(float("nan"), found)
        if np.isfinite(found):
            return Reading(float(found))
        return Reading(float("nan"), self._lack(rock))

    def _lack(self, rock: RockView) -> Reason:
        count = len(rock.points_m if self.needs_range else rock.outline_px)
        if self.needs_range and count == 0:
            return Reason.NO_RANGE
        return Reason.TOO_SMALL if count < self.fewest else Reason.DEGENERATE
