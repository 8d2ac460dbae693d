"""Shape of a rock from its mask, with scikit-image alone."""

import math

from skimage.measure import regionprops


def shape(mask):
    """Return the circularity and the axis ratio of one rock, mask (rows, cols) of bool."""
    region = regionprops(mask.astype("uint8"))[0]
    return {
        "circularity": 4 * math.pi * region.area / region.perimeter_crofton**2,
        "axis_ratio": region.axis_minor_length / region.axis_major_length,
    }
