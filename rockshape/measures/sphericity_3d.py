"""3-D sphericity: the maximum projection sphericity of the rock's ellipsoid.

Meaning: how near the three axes are to equal, c against a and b: a sphere has 1, a plate or a rod
little. Geologists read from it how a rock settles and rolls.

Formula: (c²/(ab))^(1/3) with half-axes a >= b >= c (equation 2). `paper` takes the ellipsoid of
nine parameters of least D_S through the points seen (equations 8 and 11), `robust` the one that
also touches the outline's rays and rests on the ground.

Range and unit: 0 to 1, no unit, whatever the scale.

Blind to: edges and relief. The paper's reading also to the rock's far side, which range does not
see: on rocks of known axes its error is twice to three times the robust reading's. The robust
reading takes a buried rock for one that rests, and so for flatter than it is.

Smallest size: 30 points of range. On exact range rocks of 25 px across still have it to 0.03; what
limits it is range noise, and less so held (`python benchmarks/run.py solids`).

Degenerate: NaN for fewer points, points on one line, an axis that the points do not determine (it
stands at its bound) and a search that did not converge.

Source: Sneed and Folk (1958); Fox et al. (2002), equation 2, which names it beside Krumbein's.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid import MIN_POINTS
from rockshape.measures.measure import Measure
from rockshape.rock.view import RockView


def sphericity_3d(half_axes_m: NDArray[np.float64]) -> float:
    """Maximum projection sphericity (c²/(ab))^(1/3) of half-axes (3,) in any order; 1 for a sphere.

    Source: Sneed and Folk (1958); Fox et al. (2002), equation 2.
    """
    c, b, a = np.sort(half_axes_m)
    return float(np.cbrt(c * c / (a * b)))


def _evaluate(rock: RockView) -> float:
    if rock.ellipsoid is None:
        return float("nan")
    return sphericity_3d(rock.ellipsoid.ellipsoid.half_axes_m)


def _evaluate_held(rock: RockView) -> float:
    if rock.held_ellipsoid is None:
        return float("nan")
    return sphericity_3d(rock.held_ellipsoid.half_axes_m)


PAPER = Measure(
    column="sphericity_3d",
    title="3-D sphericity",
    paper_name="3-D sphericity",
    needs_range=True,
    min_points=MIN_POINTS,
    evaluate=_evaluate,
    expected_trait="form",
    equals=("maximum_projection_sphericity",),
    value_range=(0.0, 1.0),
)
ROBUST = replace(PAPER, evaluate=_evaluate_held, constrained=True)
