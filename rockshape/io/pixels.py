"""Pixel values of any common type as intensities from 0 to 1."""

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError

MAX_CHANNELS = 4  # red, green, blue and alpha
UNIT_TOLERANCE = 1e-3  # of floats from 0 to 1: rounding, and the overshoot of a resampling
FULL_SCALE = {np.dtype(np.uint8): 255, np.dtype(np.uint16): 65535}


def to_unit(pixels: NDArray[np.generic]) -> NDArray[np.float32]:
    """Image (rows, cols) grey or (rows, cols, 3) RGB, from 0 to 1; alpha is dropped.

    pixels is (rows, cols) or (rows, cols, channels), of 8 or 16 bits or floats from 0 to 1; of one
    or two channels the first is grey, of more the first three are red, green and blue. A float that
    is not finite is black.
    Raises: InputError for any other shape, type or range of floats.
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


def to_levels(pixels: NDArray[np.generic]) -> NDArray[Any]:
    """Pixels of any type that a file holds, as a type that `to_unit` accepts.

    8 and 16 bits, and floats from 0 to 1, are kept. Whole numbers of any type are taken for 8 bits
    where none is above 255, for 16 where none is above 65535. Anything else is stretched from the
    0.1th to the 99.9th percentile of what is finite; a pixel that is not finite is black.
    Raises: InputError for what is no number.
    """
    if pixels.dtype in FULL_SCALE:
        return pixels
    if pixels.dtype.kind not in "biuf":
        raise InputError(f"image: expected numbers, found {pixels.dtype}")
    if pixels.dtype == bool:
        return pixels.astype(np.uint8) * np.uint8(255)
    values = pixels.astype(np.float32)
    finite = values[np.isfinite(values)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
    whole = pixels.dtype.kind in "iu" or bool(high > 1 and (np.rint(finite) == finite).all())
    if whole and low >= 0 and high <= 65535:
        return np.nan_to_num(values, posinf=0).astype(np.uint8 if high <= 255 else np.uint16)
    return stretch(values) if low < 0 or high > 1 else np.nan_to_num(values, posinf=0)


def stretch(pixels: NDArray[np.generic]) -> NDArray[np.float32]:
    """Pixels from 0 at their 0.1th percentile to 1 at their 99.9th; 0 where they are not finite."""
    values = np.where(np.isfinite(pixels), pixels, np.nan).astype(np.float32)
    sparse = values[:: 1 + len(values) // 1000]  # of many rows a thousand
    if np.isnan(sparse).all():
        return np.zeros_like(values)
    low, high = (float(each) for each in np.nanpercentile(sparse, (0.1, 99.9)))
    span = max(high - low, float(np.finfo(np.float32).tiny))
    return np.asarray(np.nan_to_num(np.clip((values - low) / span, 0, 1)), dtype=np.float32)


def _opaque(pixels: NDArray[np.generic]) -> NDArray[Any]:
    """Pixels (rows, cols) or (rows, cols, 3) without alpha, of their own type or float32."""
    channels = pixels.shape[2:] or (1,)
    if pixels.ndim not in (2, 3) or 0 in pixels.shape or channels[0] > MAX_CHANNELS:
        raise InputError(f"image: expected (rows, cols) or (rows, cols, 3), found {pixels.shape}")
    if np.issubdtype(pixels.dtype, np.floating):
        pixels = _checked(pixels.astype(np.float32))
    elif pixels.dtype not in FULL_SCALE:
        raise InputError(f"image: expected 8 or 16 bits a channel, found {pixels.dtype}")
    if pixels.ndim == 2:
        return pixels
    return pixels[..., 0] if pixels.shape[2] < 3 else pixels[..., :3]


def _checked(pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Floats from 0 to 1, what is not finite black. Raises: InputError where any lie outside."""
    finite = np.isfinite(pixels)
    low, high = pixels.min(where=finite, initial=0), pixels.max(where=finite, initial=1)
    if low < -UNIT_TOLERANCE or high > 1 + UNIT_TOLERANCE:
        raise InputError(f"image: expected floats from 0 to 1, found {low:g} to {high:g}")
    pixels[~finite] = 0
    return pixels


def _scaled(pixels: NDArray[Any]) -> NDArray[np.float32]:
    intensities = pixels.astype(np.float32)
    intensities /= np.float32(FULL_SCALE.get(pixels.dtype, 1))  # in place: pictures are large
    return intensities
