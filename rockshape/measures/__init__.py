"""The measures, in the order of the table. To add one: write its file and name it here."""

from rockshape.measures import (
    angularity_2d,
    angularity_3d,
    axis_ratio,
    ellipse_error,
    ellipsoid_error,
    roughness_2d,
    roughness_3d,
    roundness,
    sphericity_2d,
    sphericity_3d,
)
from rockshape.measures.measure import Measure, Trait
from rockshape.measures.reading import Reading, Reason

PAPER = (
    axis_ratio.PAPER,
    ellipse_error.PAPER,
    sphericity_2d.PAPER,
    angularity_2d.PAPER,
    ellipsoid_error.PAPER,
    sphericity_3d.PAPER,
    angularity_3d.PAPER,
)
ROBUST = (
    axis_ratio.ROBUST,
    ellipse_error.ROBUST,
    sphericity_2d.ROBUST,
    angularity_2d.ROBUST,
    roundness.ROBUST,
    ellipsoid_error.ROBUST,
    sphericity_3d.ROBUST,
    angularity_3d.ROBUST,
    roughness_3d.ROBUST,
)

ON_DEMAND = (roughness_2d.ROBUST,)  # in no table: few rocks have enough pixels for it

__all__ = ["ON_DEMAND", "PAPER", "ROBUST", "Measure", "Reading", "Reason", "Trait"]
