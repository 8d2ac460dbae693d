"""Black top-hat and watershed: grains are what no narrow dark gap takes."""

import cv2
import numpy as np
from skimage.filters import threshold_otsu

from rockshape import Finder, Observation, Segmentation
from validation.arrays import Labels
from validation.peers.finders.regions import parted, segmentation

GAP_PX = 15  # wider dark regions are no gaps


def top_hat(observation: Observation) -> Labels:
    """What is below Otsu's threshold of the black top-hat, parted by a watershed.

    Source: gaps as in BASEGRAIN, Detert and Weitbrecht 2012.
    """
    levels = np.clip(np.rint(observation.image * 255), 0, 255).astype(np.uint8)
    smooth = cv2.medianBlur(levels, 3)
    disk = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (GAP_PX, GAP_PX))
    gaps = cv2.morphologyEx(smooth, cv2.MORPH_BLACKHAT, disk)
    if np.ptp(gaps) == 0:
        return np.zeros(gaps.shape, dtype=np.int32)
    return parted(np.asarray(gaps <= threshold_otsu(gaps)), smoothing_px=1.0)


def _segment(observation: Observation) -> Segmentation:
    return segmentation(top_hat(observation))


FINDER = Finder("top-hat", "parted by dark gaps (black top-hat), then a watershed", _segment)
