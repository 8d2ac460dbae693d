"""Rocks of crops painted darker, brighter or of another colour than they were."""

import cv2
import numpy as np
from numpy.typing import NDArray

Singles = NDArray[np.float32]
_SHARE = 0.5
_DARKEST, _BRIGHTEST = -1.5, 0.5  # logarithm of the factor, of all rocks of a crop
_EACH = 0.25  # standard deviation of its logarithm among them
_TINT = 0.15
_DUSTED = 0.4  # share of crops that keep some of the ground's colour in patches
_SOFT_PX = 0.7


def repainted(picture: Singles, labels: NDArray[np.uint16], rng: np.random.Generator) -> Singles:
    """Picture (rows, cols, 3) in which rocks, (rows, cols) from 1, are other than they were.

    Rocks of the field differ from the ground in brightness by more than made ones do: basalt lies
    on bright dust. All of a crop's rocks take one factor and one tint, and each a factor beside.
    """
    if rng.uniform() >= _SHARE or not labels.any():
        return picture
    count = int(labels.max()) + 1
    level = rng.uniform(_DARKEST, _BRIGHTEST) + rng.normal(0.0, _EACH, count)
    level[0] = 0.0
    tint = np.exp(rng.normal(0.0, _TINT, 3)).astype(np.float32)
    each = np.exp(level).astype(np.float32)[labels][..., None] * tint
    factor = np.where(labels[..., None] > 0, each, np.float32(1.0)).astype(np.float32)
    if rng.uniform() < _DUSTED:
        factor **= _patches(labels.shape, rng)[..., None]
    soft = cv2.GaussianBlur(factor, (0, 0), _SOFT_PX)
    return np.asarray(picture * soft, dtype=np.float32)


def _patches(shape: tuple[int, ...], rng: np.random.Generator) -> Singles:
    """Share (rows, cols) from 0 to 1 to which a place is painted, in patches."""
    coarse = rng.uniform(0.0, 1.6, (9, 9)).astype(np.float32)
    share = cv2.resize(coarse, (shape[1], shape[0]), interpolation=cv2.INTER_CUBIC)
    return np.asarray(np.clip(share, 0.0, 1.0), dtype=np.float32)
