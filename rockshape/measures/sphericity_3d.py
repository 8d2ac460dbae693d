"""3-D sphericity: the maximum projection sphericity of the fitted ellipsoid."""

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid import FEWEST_POINTS
from rockshape.measures.measure import Measure, RockView


def sphericity_3d(half_axes_m: NDArray[np.float64]) -> float:
    """Maximum projection sphericity (c²/(ab))^(1/3) of half-axes (3,) in any order; 1 for a sphere.

    From one side an ellipsoid is badly determined: on rocks of known axes the range points alone
    gave a mean error of 0.08.
    Source: Sneed and Folk (1958); Fox et al. (2002), equation 2.
    """
    c, b, a = np.sort(half_axes_m)
    return float(np.cbrt(c * c / (a * b)))


def _evaluate(rock: RockView) -> float:
    if rock.ellipsoid is None:
        return float("nan")
    return sphericity_3d(rock.ellipsoid.ellipsoid.half_axes_m)


MEASURE = Measure(
    column="sphericity_3d",
    title="3-D sphericity",
    paper_name="3-D sphericity",
    unit="",
    needs_range=True,
    fewest=FEWEST_POINTS,
    evaluate=_evaluate,
)
