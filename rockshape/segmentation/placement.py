"""Placement of rocks that a picture shows among those that are found already."""

from collections.abc import Iterable, Iterator

import numpy as np
import scipy.ndimage as ndi

from rockshape.numerics.arrays import Labels, Mask
from rockshape.outline.polygon_fill import Window
from rockshape.segmentation.by_range.height_signal import HeightSignal
from rockshape.segmentation.relabel import label_areas

MAX_SHARED = 0.25  # of an outline may be another's already
SWALLOWED = 0.5  # of a better one within an outline: it is two rocks, not one
MIN_HEIGHT = 0.25  # of a rock's width: its height, if the range there is to confirm it
SURE_SIGMA = 6.0  # a rock as high as this in the noise would show in range; without, it is none
FLAT_SIGMA = 1.5


def place_among(
    found: Labels, relief: HeightSignal | None, candidates: Iterable[tuple[Window, Mask]]
) -> Labels:
    """Labels found already (rows, cols), and after them candidates, the best first.

    A candidate, a mask within a window, is left out where a quarter of it is taken already, where
    it swallows another, and where range good enough to show a rock of its width is flat.
    """
    labels = found.copy()
    area = label_areas(labels).tolist()
    for window, mask in candidates:
        part = labels[window]
        shared = np.bincount(part[mask], minlength=len(area))
        pixels, free = int(mask.sum()), int(shared[0])
        if pixels - free > MAX_SHARED * pixels:
            continue
        others = np.flatnonzero(shared[1:]) + 1
        if any(shared[other] > SWALLOWED * area[other] for other in others):
            continue
        if relief is not None and _is_flat(relief, window, mask):
            continue
        part[mask & (part == 0)] = len(area)
        area.append(free)
    return labels


def largest_first(labels: Labels) -> Iterator[tuple[Window, Mask]]:
    """Rocks of a label image (rows, cols) as masks within their windows, the largest first."""
    windows = ndi.find_objects(labels)
    area = label_areas(labels)[1:]
    for index in np.argsort(-area, kind="stable"):
        window = windows[index]
        if window is not None:
            yield window, labels[window] == index + 1


def _is_flat(relief: HeightSignal, window: Window, mask: Mask) -> bool:
    """Whether range that would show a rock there shows none."""
    known = mask & relief.known[window]
    if known.sum() < 0.5 * mask.sum():
        return False
    depth = float(np.median(relief.depth_m[window][known]))
    sigma = float(np.median(relief.sigma_m[window][known]))
    height_m = MIN_HEIGHT * mask.shape[1] * relief.pixel_rad * depth
    signal = float(np.quantile(relief.signal[window][known], 0.8))
    return bool(height_m > SURE_SIGMA * sigma and signal < FLAT_SIGMA)
