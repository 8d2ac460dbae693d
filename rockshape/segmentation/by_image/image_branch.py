"""Rocks that the image alone shows: too low or too far for range, or without any range."""

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Floats, Labels
from rockshape.outline.polygon_fill import inside_of
from rockshape.segmentation.by_image.ground_appearance import read_lightness
from rockshape.segmentation.by_image.proposal_score import features_of, likelihood
from rockshape.segmentation.by_image.proposal_seeds import MIN_PIXELS
from rockshape.segmentation.by_image.star_proposals import propose
from rockshape.segmentation.by_range.height_signal import HeightSignal
from rockshape.segmentation.placement import place_among

GOOD_ENOUGH = 0.4


def find_by_image(
    image: NDArray[np.float32], relief: HeightSignal | None, by_range: Labels
) -> Labels:
    """The labels by range (rows, cols), and after them rocks that the image shows beside.

    Outlines proposed are taken from the likeliest down, as far as they have room and range does not
    speak against them.
    """
    x, y = _likeliest(image, by_range)  # before anything else is held in memory
    masks = (inside_of(one, two, by_range.shape) for one, two in zip(x, y, strict=True))
    wide = ((window, mask) for window, mask in masks if int(mask.sum()) >= MIN_PIXELS)
    return place_among(by_range, relief, wide)


def _likeliest(image: NDArray[np.float32], taken: Labels) -> tuple[Floats, Floats]:
    """Proposed outlines (n, points) that are good enough, the likeliest first."""
    parts = [
        (part.x, part.y, features_of(part)) for part in propose(read_lightness(image), taken=taken)
    ]
    if not parts:
        return np.empty((0, 0)), np.empty((0, 0))
    x, y, features = (np.concatenate(each) for each in zip(*parts, strict=True))
    value = likelihood(features)
    order = np.argsort(-value, kind="stable")
    order = order[value[order] >= GOOD_ENOUGH]
    return x[order], y[order]
