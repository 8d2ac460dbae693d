"""Axis ratio of the fitted ellipse, the paper's "eccentricity"."""

from rockshape.ellipse import FEWEST_POINTS, Ellipse
from rockshape.measures.measure import Measure, RockView


def axis_ratio(ellipse: Ellipse) -> float:
    """Minor over major axis of the ellipse fitted to the outline, b/a; 1 for a circle.

    Not the eccentricity sqrt(1 - b²/a²) of geometry, though the paper calls it so.
    Source: Fox et al. (2002), section 2, Ellipse Fitting.
    """
    return ellipse.axis_ratio


def _evaluate(rock: RockView) -> float:
    return float("nan") if rock.ellipse is None else axis_ratio(rock.ellipse)


MEASURE = Measure(
    column="axis_ratio",
    title="axis ratio",
    paper_name="eccentricity",
    unit="",
    needs_range=False,
    fewest=FEWEST_POINTS,
    evaluate=_evaluate,
)
