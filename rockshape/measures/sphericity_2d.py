"""2-D sphericity: the aspect ratio of the outline."""

import numpy as np
from numpy.typing import NDArray

from rockshape.measures.measure import Measure, RockView


def sphericity_2d(outline_px: NDArray[np.float64]) -> float:
    """Short over long side of the outline's upright bounding box, (0, 1].

    outline_px is (n, 2), centres of boundary pixels, so a side is the extent plus one pixel.
    The paper says no more than "aspect ratio"; among the candidates this one agrees best with its
    table 4. It changes when the image is turned: a thin rock at 45 degrees scores 1.
    NaN for an empty outline.
    Source: Fox et al. (2002), section 3, Sphericity Test.
    """
    if len(outline_px) == 0:
        return float("nan")
    sides = np.ptp(outline_px, axis=0) + 1
    return float(sides.min() / sides.max())


def _evaluate(rock: RockView) -> float:
    return sphericity_2d(rock.outline_px)


MEASURE = Measure(
    column="sphericity_2d",
    title="2-D sphericity",
    paper_name="2-D sphericity",
    unit="",
    needs_range=False,
    fewest=1,
    evaluate=_evaluate,
)
