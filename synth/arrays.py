"""Named array types: what the arrays of the public interface hold."""

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.uint8] | NDArray[np.uint16]
"""Grey levels, (rows, cols): 8 bits, or 12 bits in the upper bits of 16; linear in light."""

DepthImage = NDArray[np.float64]
"""Z-depth of the pixels' centres, (rows, cols), in metres; NaN where nothing was measured."""

LabelImage = NDArray[np.uint16]
"""Label of the rock seen at each pixel's centre, (rows, cols); 0 elsewhere."""
