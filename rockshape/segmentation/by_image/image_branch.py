"""Rocks that the image alone shows: too low or too far for range, or without any range."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Labels, Mask
from rockshape.outline.polygon_fill import Window, inside_of
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
    return place_among(by_range, relief, _candidates(image, by_range))


def _candidates(image: NDArray[np.float32], taken: Labels) -> Iterator[tuple[Window, Mask]]:
    """Yield the proposed outlines that are good enough, the likeliest first."""
    parts = [
        (part.x, part.y, features_of(part)) for part in propose(read_lightness(image), taken=taken)
    ]
    if not parts:
        return
    x, y, features = (np.concatenate(each) for each in zip(*parts, strict=True))
    value = likelihood(features)
    for number in np.argsort(-value, kind="stable"):
        if value[number] < GOOD_ENOUGH:
            return
        window, mask = inside_of(x[number], y[number], taken.shape)
        if int(mask.sum()) >= MIN_PIXELS:
            yield window, mask
