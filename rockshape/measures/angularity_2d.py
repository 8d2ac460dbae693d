"""2-D angularity: the spread of the angles that triangles inscribed in the outline have."""

import numpy as np
from numpy.typing import NDArray

from rockshape.measures.measure import Measure, RockView

ALPHA = 2
BETA = 9


def angularity_2d_deg(
    outline_px: NDArray[np.float64], *, alpha: int = ALPHA, beta: int = BETA
) -> float:
    """Standard deviation over the outline of each point's flattest inscribed angle, in degrees.

    At each point i the triangles with corners h and j, alpha < i - h < beta and
    alpha < j - i < beta, have the angle hij = arccos((a² + b² - c²)/(2ab)), with a, b the sides
    that meet at i; rho_i is the largest of them, and the measure
    sqrt(sum (rho_i - mean rho)² / (N - 1)). outline_px is (N, 2) and closed. With alpha = 2 and
    beta = 9 the offsets are 3 to 8 on each side: 36 triangles a point.

    Rises with angularity. On pixels a circle does not score 0 but about 12, 7.2, 3.7 and 2.4
    degrees at a radius of 6, 20, 50 and 100 pixels, so the measure falls with size.
    A triangle with a side of no length is left out. NaN for fewer than 2 beta - 1 points, where the
    corners would meet behind the point.
    Source: Fox et al. (2002), equations 6 and 7 and figure 3.
    """
    count = len(outline_px)
    if count < 2 * beta - 1:
        return float("nan")
    offsets = np.arange(alpha + 1, beta)
    index = np.arange(count)[:, None]
    # complex numbers for the sides: the angle between two is that of one over the other
    x, y = outline_px.T
    points = x + 1j * y
    before = points[(index - offsets) % count] - points[:, None]
    after = points[(index + offsets) % count] - points[:, None]
    product = before[:, :, None] * after.conj()[:, None, :]
    length = np.abs(before)[:, :, None] * np.abs(after)[:, None, :]
    cosine = np.divide(product.real, length, out=np.ones_like(length), where=length > 0)
    flattest = np.arccos(np.clip(cosine, -1, 1)).max(axis=(1, 2))
    return float(np.degrees(flattest.std(ddof=1)))


def _evaluate(rock: RockView) -> float:
    return angularity_2d_deg(rock.outline_px)


MEASURE = Measure(
    column="angularity_2d_deg",
    title="2-D angularity",
    paper_name="2-D angularity",
    unit="°",
    needs_range=False,
    fewest=2 * BETA - 1,
    evaluate=_evaluate,
)
