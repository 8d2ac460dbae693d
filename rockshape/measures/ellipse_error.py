"""Ellipse fitting error: how far the outline lies from its ellipse."""

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipse import FEWEST_POINTS, Ellipse
from rockshape.measures.measure import Measure, RockView


def ellipse_error_px2(
    ellipse: Ellipse, outline_px: NDArray[np.float64], *, total: bool = False
) -> float:
    """Mean squared radial distance of the outline, (n, 2), from its ellipse, in px².

    The text says sum, the published values say mean: pixel quantisation alone sums to 4 to 39 px²,
    where table 4 has 0.30. `total` gives the sum. Pixels alone give a mean near 0.07 px²; for one
    form the error grows with the square of its size in pixels. NaN for an empty outline.
    Source: Fox et al. (2002), section 2, Ellipse Fitting, and figure 2.
    """
    if len(outline_px) == 0:
        return float("nan")
    squares = ellipse.radial_distance(outline_px) ** 2
    return float(squares.sum() if total else squares.mean())


def _evaluate(rock: RockView) -> float:
    return (
        float("nan") if rock.ellipse is None else ellipse_error_px2(rock.ellipse, rock.outline_px)
    )


MEASURE = Measure(
    column="ellipse_error_px2",
    title="ellipse error",
    paper_name="ellipse fitting error",
    unit="px²",
    needs_range=False,
    fewest=FEWEST_POINTS,
    evaluate=_evaluate,
)
