"""Otsu's threshold of Lab b*: rocks are its blue side, as on ground that is yellow with dust."""

import numpy as np
from skimage.color import rgb2lab
from skimage.filters import threshold_otsu

from rockshape import Finder, Observation, Segmentation
from validation.arrays import Labels
from validation.peers.finders.regions import connected, segmentation

MIN_RANGE = 0.1  # of b*, which conversion alone gives the greys of an image of three channels


def otsu_b(observation: Observation) -> Labels:
    """Connected regions bluer than Otsu's threshold of Lab b*; none without colour.

    Source: Otsu 1979; CIE 1976.
    """
    colour = observation.colour
    nothing = np.zeros(observation.image.shape, dtype=np.int32)
    if colour is None or colour.shape[-1] < 3:
        return nothing
    b = rgb2lab(colour[..., :3])[..., 2]
    if np.ptp(b) < MIN_RANGE:
        return nothing
    return connected(b < threshold_otsu(b))


def _segment(observation: Observation) -> Segmentation:
    return segmentation(otsu_b(observation))


FINDER = Finder("otsu-b", "connected regions bluer than Otsu's threshold of Lab b*", _segment)
