"""What anyone would try first: a fixed height, Otsu's threshold, a plain watershed."""

from collections.abc import Callable, Mapping

import cv2
import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray
from skimage.feature import peak_local_max
from skimage.filters import threshold_otsu
from skimage.segmentation import watershed

from rockshape.ground import fit_plane
from rockshape.observation import Observation
from validation.arrays import Labels

HEIGHT_M = 0.03
MIN_PIXELS = 40
PEAK_DISTANCE_PX = 7


def fixed_height(observation: Observation) -> Labels:
    """Connected regions higher than 3 cm above the plane of 3-sigma rejection."""
    return _parts(_high(observation))


def otsu(observation: Observation) -> Labels:
    """Connected regions darker than Otsu's threshold of the whole image."""
    image = observation.image
    if np.ptp(image) == 0:
        return np.zeros(image.shape, dtype=np.int32)
    return _parts(image < threshold_otsu(image))


def plain_watershed(observation: Observation) -> Labels:
    """The watershed of the distance within regions higher than 3 cm, from its local maxima."""
    mask = _high(observation)
    distance = cv2.distanceTransform(mask.astype(np.uint8), cv2.DIST_L2, 5)
    peaks = peak_local_max(distance, min_distance=PEAK_DISTANCE_PX, labels=mask.astype(np.int32))
    markers = np.zeros(mask.shape, dtype=np.int32)
    markers[tuple(peaks.T)] = np.arange(1, len(peaks) + 1)
    return _large(np.asarray(watershed(-distance, markers=markers, mask=mask), dtype=np.int32))


def _high(observation: Observation) -> NDArray[np.bool_]:
    points_m = observation.points_m
    plane = None if points_m is None else fit_plane(points_m)
    if plane is None or points_m is None:
        return np.zeros(observation.image.shape, dtype=bool)
    return np.asarray(np.nan_to_num(plane.height_m(points_m)) > HEIGHT_M)


def _parts(mask: NDArray[np.bool_]) -> Labels:
    labels, _ = ndi.label(mask)
    return _large(np.asarray(labels, dtype=np.int32))


def _large(labels: Labels) -> Labels:
    return np.where((np.bincount(labels.ravel()) >= MIN_PIXELS)[labels], labels, 0)


BASELINES: Mapping[str, Callable[[Observation], Labels]] = {
    "height": fixed_height,
    "otsu": otsu,
    "watershed": plain_watershed,
}
