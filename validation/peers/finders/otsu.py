"""Otsu's threshold of the image: rocks are its dark side."""

import numpy as np
from skimage.filters import threshold_otsu

from rockshape import Finder, Observation, Segmentation
from validation.arrays import Labels
from validation.peers.finders.regions import connected, segmentation


def otsu(observation: Observation) -> Labels:
    """Connected regions darker than Otsu's threshold of the whole image.

    Source: Otsu 1979.
    """
    image = observation.image
    if np.ptp(image) == 0:
        return np.zeros(image.shape, dtype=np.int32)
    return connected(image < threshold_otsu(image))


def _segment(observation: Observation) -> Segmentation:
    return segmentation(otsu(observation))


FINDER = Finder("otsu", "connected regions darker than Otsu's threshold", _segment)
