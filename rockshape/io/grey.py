"""Pixels of any common kind as grey from 0 to 1."""

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError

FULL = {np.dtype(np.uint8): 255, np.dtype(np.uint16): 65535}


def to_grey(pixels: NDArray[np.generic]) -> NDArray[np.float32]:
    """A grey image, (rows, cols) from 0 to 1. Colour becomes luma (ITU-R BT.601).

    pixels is (rows, cols) or (rows, cols, channels), of 8 or 16 bits or floats from 0 to 1; of two
    channels the first is grey, of four the first three are red, green and blue.
    Raises InputError for any other shape or type.
    """
    if pixels.ndim not in (2, 3) or 0 in pixels.shape:
        raise InputError(f"image: expected (rows, cols) or (rows, cols, 3), found {pixels.shape}")
    floating = np.issubdtype(pixels.dtype, np.floating)
    if not floating and pixels.dtype not in FULL:
        raise InputError(f"image: expected 8 or 16 bits a channel, found {pixels.dtype}")
    full = np.float32(1 if floating else FULL[pixels.dtype])
    if floating:
        pixels = pixels.astype(np.float32)
    if pixels.ndim == 3:
        pixels = (
            pixels[..., 0]
            if pixels.shape[2] < 3
            else cv2.cvtColor(np.ascontiguousarray(pixels[..., :3]), cv2.COLOR_RGB2GRAY)
        )
    return np.asarray(pixels, dtype=np.float32) / full
