"""Named array types; shapes and units stand where they are used."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Mask = NDArray[np.bool_]
Labels = NDArray[np.int32]  # (rows, cols), 0 the ground
