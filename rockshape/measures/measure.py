"""What a measure is: one number for one rock, with a name and a unit."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipse import Ellipse
from rockshape.ellipsoid import EllipsoidFit
from rockshape.surface import Surface


@dataclass(frozen=True, eq=False)
class RockView:
    """One rock as one image shows it: what every measure is computed from."""

    outline_px: NDArray[np.float64]  # (n, 2) as (x, y), clockwise
    points_m: NDArray[np.float64]  # (k, 3) in the camera frame, empty without range
    ellipse: Ellipse | None  # None where the outline does not determine it
    ellipsoid: EllipsoidFit | None  # None where the points do not
    surface: Surface | None  # likewise


@dataclass(frozen=True)
class Measure:
    """A column of the table and the function that fills it; NaN where it cannot be measured."""

    column: str
    title: str  # the field's term
    paper_name: str  # what Fox et al. (2002) call it
    unit: str  # empty for a pure number
    needs_range: bool
    fewest: int  # outline points, or range points where it needs range, below which it is NaN
    evaluate: Callable[[RockView], float]
