"""A finder from outside in one file: rocks are what is darker than the ground."""

import numpy as np

from rockshape import Finder, FoundRock, Instances, Observation, Segmentation


def _segment(observation: Observation) -> Segmentation:
    rows, cols = observation.image.shape
    rocks = Instances.from_labels((observation.image < 0.3).astype(np.int32))
    found = tuple(FoundRock(rock.id, "image") for rock in rocks)
    return Segmentation(rocks, None, (slice(0, rows), slice(0, cols)), found)


FINDER = Finder("dark", "rocks darker than the ground", _segment)
