"""Measure record: one number for one rock, with its name, its unit and what it is held to."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from rockshape.measures.reading import NAN, Reading, Reason
from rockshape.rock.view import RockView

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Trait = Literal["angularity", "roundness", "roughness", "form"]


@dataclass(frozen=True)
class Measure:
    """Column of the table, the function that fills it, and what its values are held to.

    `evaluate` returns the value for one rock; NaN, or the Reason if it knows one, where it cannot.
    `evaluate_batch` takes all rocks of an image at once and returns as many results; where it is
    given, it is called in place of `evaluate`.

    `expected_trait`, `view_truth` and `equals` declare how a measure is judged against rocks of
    known shape. A truth is named as in the records of `validation` without their `truth_`; those of
    an outline, a drawn shape's too, begin with `outline_`, the others are the solid's.
    """

    column: str
    title: str  # the field's term
    min_points: int  # outline points, or range points where it needs range, below which it is NaN
    evaluate: Callable[[RockView], float | Reason]
    unit: str = ""  # of a pure number, none
    needs_range: bool = False
    evaluate_batch: Callable[[Sequence[RockView]], Sequence[float | Reason]] | None = None
    paper_name: str = ""  # what Fox et al. (2002) call it; empty where they have no such measure
    whole: bool = False  # refuses a rock that the frame has cut
    constrained: bool = False  # its ellipsoid also touches the silhouette and rests on the ground
    expected_trait: Trait | None = None  # the trait that it rises with; None: not judged
    view_truth: str = ""  # truth of a view's outline that its values rank, `outline_roundness` say
    equals: str = ""  # truth that is the same quantity, so that the difference is an error
    value_range: tuple[float, float] = (0.0, float("inf"))
    figure: "Callable[[], Figure] | None" = None  # draws its picture in docs/measures.md

    def read(self, rock: RockView) -> Reading:
        """Measure one rock.

        NaN without a reason of its own is `no range` where range is needed and no point has it,
        `too small` under the fewest points, and `degenerate` otherwise.
        """
        if self.whole and rock.truncated:
            return self._refuse(Reason.TRUNCATED)
        return self._reading(rock, self.evaluate(rock))

    def read_all(self, rocks: Sequence[RockView]) -> list[Reading]:
        """Measure the rocks of one image, in one call where the measure takes a batch.

        Raises: ValueError where a batch's results are not as many as its rocks.
        """
        if self.evaluate_batch is None:
            return [self.read(rock) for rock in rocks]
        asked = [rock for rock in rocks if not (self.whole and rock.truncated)]
        answers = iter(zip(asked, self.evaluate_batch(asked), strict=True))
        return [
            self._refuse(Reason.TRUNCATED)
            if self.whole and rock.truncated
            else self._reading(*next(answers))
            for rock in rocks
        ]

    def _reading(self, rock: RockView, found: float | Reason) -> Reading:
        if isinstance(found, Reason):
            return self._refuse(found)
        if np.isfinite(found):
            return Reading(float(found), self.unit)
        return self._refuse(self._lack(rock))

    def _refuse(self, reason: Reason) -> Reading:
        return Reading(NAN, self.unit, reason)

    def _lack(self, rock: RockView) -> Reason:
        count = len(rock.points_m if self.needs_range else rock.outline_px)
        if self.needs_range and count == 0:
            return Reason.NO_RANGE
        return Reason.TOO_SMALL if count < self.min_points else Reason.DEGENERATE
