"""Local threshold and watershed: grains are brighter than their surroundings."""

import numpy as np
from skimage.filters import threshold_local
from skimage.morphology import disk, opening

from rockshape import Finder, Observation, Segmentation
from validation.arrays import Labels
from validation.peers.finders.regions import parted, segmentation

BLOCK_PX = 101  # this and the radius suit made beds of seed 500
OPENING_PX = 3  # radius


def local_threshold(observation: Observation) -> Labels:
    """What is brighter than a Gaussian mean of 101 pixels, opened and parted by a watershed."""
    image = observation.image
    bright = image > threshold_local(image, BLOCK_PX)
    return parted(np.asarray(opening(bright, disk(OPENING_PX))), smoothing_px=1.0)


def _segment(observation: Observation) -> Segmentation:
    return segmentation(local_threshold(observation))


FINDER = Finder("local-threshold", "brighter than the surroundings, then a watershed", _segment)
