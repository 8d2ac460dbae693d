"""Normal images: unit normals to and from 16 bits."""

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles

_STEPS = 32767.0  # on either side of the middle


def encode_normals(normals: Singles) -> NDArray[np.uint16]:
    """Normal image (rows, cols, 3): round(32767 (n + 1)) + 1 of each component; 0 where NaN."""
    levels = np.rint(_STEPS * (normals.astype(np.float64) + 1.0)) + 1.0
    return np.nan_to_num(levels, nan=0.0).astype(np.uint16)


def decode_normals(image: NDArray[np.uint16]) -> Singles:
    """Unit normals (rows, cols, 3), NaN where nothing is, as a reader of the image has them."""
    normals = (image.astype(np.float64) - 1.0) / _STEPS - 1.0
    normals[(image == 0).all(axis=-1)] = np.nan
    return normals.astype(np.float32)
