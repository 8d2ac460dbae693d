"""Named array types, those of the public interface with what they hold."""

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.uint8] | NDArray[np.uint16]
"""Grey levels, (rows, cols): 8 bits, or 12 bits in the upper bits of 16; linear in light."""

ColourImage = NDArray[np.uint8] | NDArray[np.uint16]
"""Red, green and blue, (rows, cols, 3); bits and light as in `Image`."""

NormalImage = NDArray[np.float32]
"""Unit normals, (rows, cols, 3), in the camera's frame; NaN where nothing is."""

DepthImage = NDArray[np.float64]
"""Z-depth of the pixels' centres, (rows, cols), in metres; NaN where nothing was measured."""

LabelImage = NDArray[np.uint16]
"""Label of the rock seen at each pixel's centre, (rows, cols); 0 elsewhere."""

# of any shape, which stands where they are used
Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]
