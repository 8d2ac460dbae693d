"""Rocks that the image alone shows: too low or too far for range, or without any range."""

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Labels
from rockshape.outline.polygon_fill import Window, inside_of
from rockshape.segmentation.by_image.ground_appearance import read_lightness
from rockshape.segmentation.by_image.proposal_score import features_of, likelihood
from rockshape.segmentation.by_image.proposal_seeds import MIN_PIXELS
from rockshape.segmentation.by_image.star_proposals import propose
from rockshape.segmentation.by_range.height_signal import HeightSignal
from rockshape.segmentation.relabel import label_areas

GOOD_ENOUGH = 0.4
MAX_SHARED = 0.25  # of an outline may be another's already
SWALLOWED = 0.5  # of a better one within an outline: it is two rocks, not one
MIN_HEIGHT = 0.25  # of a rock's width: its height, if the range there is to confirm it
SURE_SIGMA = 6.0  # a rock as high as this in the noise would show in range; without, it is none
FLAT_SIGMA = 1.5


def find_by_image(
    image: NDArray[np.float32], relief: HeightSignal | None, by_range: Labels
) -> Labels:
    """The labels by range (rows, cols), and after them rocks that the image shows beside.

    Outlines proposed are taken from the likeliest down, each unless a quarter of it is taken
    already or it swallows another. Where range is good enough to show a rock of that width and is
    flat, there is none.
    """
    parts = [
        (part.x, part.y, features_of(part))
        for part in propose(read_lightness(image), taken=by_range)
    ]
    labels = by_range.copy()
    if not parts:
        return labels
    x, y, features = (np.concatenate(each) for each in zip(*parts, strict=True))
    value = likelihood(features)
    area = label_areas(labels).tolist()
    for number in np.argsort(-value, kind="stable"):
        if value[number] < GOOD_ENOUGH:
            break
        window, mask = inside_of(x[number], y[number], labels.shape)
        pixels = int(mask.sum())
        if pixels < MIN_PIXELS:
            continue
        part = labels[window]
        shared = np.bincount(part[mask], minlength=len(area))
        free = int(shared[0])
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


def _is_flat(relief: HeightSignal, window: Window, mask: NDArray[np.bool_]) -> bool:
    """Whether range that would show a rock there shows none."""
    known = mask & relief.known[window]
    if known.sum() < 0.5 * mask.sum():
        return False
    depth = float(np.median(relief.depth_m[window][known]))
    sigma = float(np.median(relief.sigma_m[window][known]))
    height_m = MIN_HEIGHT * mask.shape[1] * relief.pixel_rad * depth
    signal = float(np.quantile(relief.signal[window][known], 0.8))
    return bool(height_m > SURE_SIGMA * sigma and signal < FLAT_SIGMA)
