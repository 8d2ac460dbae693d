"""A finder in one file: rocks are what is darker than the ground."""

import numpy as np
from scipy import ndimage

from rockshape import Finder, FoundRock, Instances, Observation, Segmentation


def segment(observation: Observation) -> Segmentation:
    """Connected regions darker than half the median."""
    dark = observation.image < 0.5 * np.median(observation.image)
    labels, _ = ndimage.label(dark)
    rocks = Instances.from_labels(labels)
    rows, cols = labels.shape
    found = tuple(FoundRock(rock.id, "image") for rock in rocks)
    return Segmentation(rocks, None, (slice(0, rows), slice(0, cols)), found)


FINDER = Finder("dark", "rocks darker than the ground", segment)
