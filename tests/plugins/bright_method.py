"""A method in one file: bright rocks, their areas, and no fits."""

import numpy as np
from scipy import ndimage

from rockshape import (
    Fits,
    FoundRock,
    Instances,
    Measure,
    Method,
    Observation,
    RockView,
    Segmentation,
)


def segment(observation: Observation) -> Segmentation:
    """Connected regions brighter than 0.6."""
    labels, _ = ndimage.label(observation.image > 0.6)
    rocks = Instances.from_labels(labels)
    rows, cols = labels.shape
    found = tuple(FoundRock(rock.id, "image") for rock in rocks)
    return Segmentation(rocks, None, (slice(0, rows), slice(0, cols)), found)


def no_ground(observation: Observation) -> None:
    """The area of a mask needs no ground."""


def no_fits(rock: RockView) -> Fits:
    """Neither ellipse nor ellipsoid in the table."""
    return Fits(ellipse=None, ellipsoid=None)


def area(rock: RockView) -> float:
    """Number of pixels."""
    return float(np.count_nonzero(rock.mask))


AREA = Measure(column="area", title="area", unit="px²", min_points=1, evaluate=area)
METHOD = Method("bright", segment=segment, ground=no_ground, fits=no_fits, measures=(AREA,))
