"""The measures, in the order of the table. To add one: write its file and name it here."""

from rockshape.measures import (
    angularity_2d,
    angularity_3d,
    axis_ratio,
    ellipse_error,
    ellipsoid_error,
    sphericity_2d,
    sphericity_3d,
)
from rockshape.measures.measure import Measure, RockView

PAPER = (
    axis_ratio.MEASURE,
    ellipse_error.MEASURE,
    sphericity_2d.MEASURE,
    angularity_2d.MEASURE,
    ellipsoid_error.MEASURE,
    sphericity_3d.MEASURE,
    angularity_3d.MEASURE,
)
METHODS: dict[str, tuple[Measure, ...]] = {"paper": PAPER}

__all__ = ["METHODS", "PAPER", "Measure", "RockView"]
