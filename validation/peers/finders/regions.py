"""Regions of a mask as rocks: connected, or parted by a watershed of the distance."""

import cv2
import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray
from skimage.feature import peak_local_max
from skimage.segmentation import watershed

from rockshape.rock.instances import Instances
from rockshape.segmentation import FoundRock, Segmentation
from validation.arrays import Labels

MIN_PIXELS = 40
PEAK_DISTANCE_PX = 7

Mask = NDArray[np.bool_]


def connected(mask: Mask) -> Labels:
    """Labels (rows, cols) of connected regions of 40 pixels and more."""
    labels, _ = ndi.label(mask)
    return _large(np.asarray(labels, dtype=np.int32))


def parted(mask: Mask, *, smoothing_px: float = 0.0) -> Labels:
    """Labels (rows, cols) of a watershed of the distance within a mask, from its local maxima.

    The distance is smoothed first by a Gaussian of that deviation. Regions have 40 pixels or more.
    Source: Meyer 1994; markers at least seven pixels apart.
    """
    distance = cv2.distanceTransform(mask.astype(np.uint8), cv2.DIST_L2, 5)
    if smoothing_px > 0:
        distance = cv2.GaussianBlur(distance, (0, 0), smoothing_px)
    peaks = peak_local_max(distance, min_distance=PEAK_DISTANCE_PX, labels=mask.astype(np.int32))
    markers = np.zeros(mask.shape, dtype=np.int32)
    markers[tuple(peaks.T)] = np.arange(1, len(peaks) + 1)
    return _large(np.asarray(watershed(-distance, markers=markers, mask=mask), dtype=np.int32))


def segmentation(labels: Labels) -> Segmentation:
    """Labels (rows, cols), 0 the ground, as what a finder returns."""
    rocks = Instances.from_labels(labels)
    rows, cols = labels.shape
    found = tuple(FoundRock(rock.id, "image") for rock in rocks)
    return Segmentation(rocks, None, (slice(0, rows), slice(0, cols)), found)


def _large(labels: Labels) -> Labels:
    return np.where((np.bincount(labels.ravel()) >= MIN_PIXELS)[labels], labels, 0)
