"""Pixel values of any common type as intensities from 0 to 1."""

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError

FULL_SCALE = {np.dtype(np.uint8): 255, np.dtype(np.uint16): 65535}


def to_unit(pixels: NDArray[np.generic]) -> NDArray[np.float32]:
    """Image (rows, cols) grey or (rows, cols, 3) RGB, from 0 to 1; alpha is dropped.

    pixels is (rows, cols) or (rows, cols, channels), of 8 or 16 bits or floats from 0 to 1; of one
    or two channels the first is grey, of more the first three are red, green and blue.
    Raises: InputError for any other shape or type.
    """
    return _scaled(_opaque(pixels))


def to_grey(pixels: NDArray[np.generic]) -> NDArray[np.float32]:
    """Luma (rows, cols), from 0 to 1, of pixels that `to_unit` accepts.

    Integer pixels keep their resolution: the luma of 8 bits is rounded to 8 bits.

    Source: ITU-R BT.601, section 2.5.1.
    """
    opaque = _opaque(pixels)
    if opaque.ndim == 3:
        opaque = np.asarray(cv2.cvtColor(np.ascontiguousarray(opaque), cv2.COLOR_RGB2GRAY))
    return _scaled(opaque)


def _opaque(pixels: NDArray[np.generic]) -> NDArray[Any]:
    """Pixels (rows, cols) or (rows, cols, 3) without alpha, of their own type or float32."""
    if pixels.ndim not in (2, 3) or 0 in pixels.shape:
        raise InputError(f"image: expected (rows, cols) or (rows, cols, 3), found {pixels.shape}")
    if np.issubdtype(pixels.dtype, np.floating):
        pixels = pixels.astype(np.float32)
    elif pixels.dtype not in FULL_SCALE:
        raise InputError(f"image: expected 8 or 16 bits a channel, found {pixels.dtype}")
    if pixels.ndim == 2:
        return pixels
    return pixels[..., 0] if pixels.shape[2] < 3 else pixels[..., :3]


def _scaled(pixels: NDArray[Any]) -> NDArray[np.float32]:
    return np.asarray(pixels, dtype=np.float32) / np.float32(FULL_SCALE.get(pixels.dtype, 1))
