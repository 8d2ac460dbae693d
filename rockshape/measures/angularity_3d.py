"""3-D angularity: the second derivatives of the B-spline surface."""

import numpy as np

from rockshape.measures.measure import Measure, RockView
from rockshape.surface import FEWEST_POINTS, Surface


def angularity_3d_per_m(surface: Surface, *, signed: bool = False) -> float:
    """Mean over the data points of |(Q_uu + Q_ww)/2|, in 1/m.

    `signed` gives equation 17 as printed, without the bars. Its bumps and hollows cancel: it is an
    integral over the rim, and ranks rocks of known roughness backwards. The absolute mean is used,
    as all published values are positive. Neither is 0 on a sphere: seen out to the radius r, a
    sphere of radius R scores 1/sqrt(R² - r²) and diverges at its limb.

    It tells relief, not the rounding of edges: across an edge the second derivative integrates to
    the change of slope, however sharp or round the edge is.
    Source: Fox et al. (2002), equations 16 and 17.
    """
    mean = (surface.second_uu_per_m + surface.second_ww_per_m) / 2
    return float(np.mean(mean if signed else np.abs(mean)))


def _evaluate(rock: RockView) -> float:
    return float("nan") if rock.surface is None else angularity_3d_per_m(rock.surface)


MEASURE = Measure(
    column="angularity_3d_per_m",
    title="3-D angularity",
    paper_name="3-D angularity",
    unit="1/m",
    needs_range=True,
    fewest=FEWEST_POINTS,
    evaluate=_evaluate,
)
