"""Ellipsoid fitting error: how far the visible surface lies from its ellipsoid."""

from rockshape.ellipsoid import FEWEST_POINTS, EllipsoidFit
from rockshape.measures.measure import Measure, RockView


def ellipsoid_error_m2(fit: EllipsoidFit) -> float:
    """Mean squared radial distance of the points from the fitted ellipsoid, D_S / N, in m².

    Rises with angularity on a rock that is an ellipsoid otherwise; a smooth box scores high too.
    Grows with the square of the rock's size.
    Source: Fox et al. (2002), section 2, Ellipsoid Fitting, after equation 11.
    """
    return fit.mean_square_m2


def _evaluate(rock: RockView) -> float:
    return float("nan") if rock.ellipsoid is None else ellipsoid_error_m2(rock.ellipsoid)


MEASURE = Measure(
    column="ellipsoid_error_m2",
    title="ellipsoid error",
    paper_name="ellipsoid fitting error",
    unit="m²",
    needs_range=True,
    fewest=FEWEST_POINTS,
    evaluate=_evaluate,
)
