"""Orientation tag of EXIF and TIFF: pixels turned as viewers turn them.

Source: Exif 2.32 (CIPA DC-008-2019), section 4.6.4, and TIFF 6.0, section 8: tag 274.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

TAG = 274
UPRIGHT = 1
SWAPPED = (5, 6, 7, 8)  # the first row of the file is a column of the picture
RIGHT_FIRST, BOTTOM_FIRST = (2, 3, 6, 7), (3, 4, 7, 8)  # where its first pixel is shown


def turn(pixels: NDArray[Any], orientation: int) -> NDArray[Any]:
    """Pixels (rows, cols, …) as a viewer shows them; a tag that is none of 1 to 8 turns nothing."""
    turned = np.swapaxes(pixels, 0, 1) if orientation in SWAPPED else pixels
    if orientation in BOTTOM_FIRST:
        turned = turned[::-1]
    return turned[:, ::-1] if orientation in RIGHT_FIRST else turned
