"""Shading of a rock: how far its changes of brightness gather at edges."""

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Floats, Mask

SMOOTHING = 0.045  # of the radius of the circle of the rock's area
RIM = 1.5  # smoothing lengths that the surroundings reach in over the rock's border
RIM_PX = 2.0  # the same at least: pixels that see both
MAX_RADIUS_PX = 64.0  # larger rocks are reduced to it
MIN_PX = 50  # fewer say nothing of a fourth moment
MIN_CONTRAST = 1 / 255  # standard deviation of the brightness: a grey level of 8 bits


def gradient_kurtosis(image: NDArray[np.floating], mask: Mask) -> float:
    """Kurtosis ⟨|∇I|⁴⟩/⟨|∇I|²⟩² of the brightness gradient of a rock's pixels; no unit.

    It is 2 where brightness is a Gaussian random field, as texture, relief and noise are nearly,
    and the higher the smaller the part of the rock where brightness changes: between the faces of
    a polyhedron it changes at the edges alone, over a round body everywhere. Neither the contrast
    nor the mean brightness nor the rock's size in pixels counts.

    image (rows, cols), black 0 to white 1, is smoothed within the mask (rows, cols) by 0.045 of the
    radius of the circle of its area. Pixels that are black, white or not finite are not lit, and no
    part of the rock here; those nearer its border than 1.5 times that length, or 2 px, are left
    out. NaN where fewer than 50 pixels are left, or their brightness varies by less than a grey
    level of 8 bits.
    """
    lit = mask & np.isfinite(image)
    lit[lit] = (image[lit] > 0) & (image[lit] < 1)
    if not lit.any():
        return float("nan")
    light, lit = _reduced(image, lit)
    length = SMOOTHING * float(np.sqrt(lit.sum() / np.pi))
    inside = np.pad(lit, 1).astype(np.uint8)
    depth = cv2.distanceTransform(inside, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)[1:-1, 1:-1]
    inner = depth > max(RIM_PX, RIM * length)
    if int(inner.sum()) < MIN_PX:
        return float("nan")
    shares = _smoothed(lit.astype(np.float64), length)
    smooth = _smoothed(np.where(lit, light, 0.0), length) / np.maximum(shares, 1e-6)
    if np.std(smooth[inner]) < MIN_CONTRAST:
        return float("nan")
    square = np.sum(np.square(np.gradient(smooth)), axis=0)[inner]
    return float(np.mean(square**2) / np.mean(square) ** 2)


def _smoothed(values: Floats, length: float) -> Floats:
    return np.asarray(cv2.GaussianBlur(values, (0, 0), length, borderType=cv2.BORDER_CONSTANT))


def _reduced(image: NDArray[np.floating], mask: Mask) -> tuple[Floats, Mask]:
    """Image and mask no larger than a rock of the greatest radius needs."""
    scale = MAX_RADIUS_PX / float(np.sqrt(max(mask.sum(), 1) / np.pi))
    light: Floats = np.where(mask, image, 0.0).astype(np.float64)
    if scale >= 1:
        return light, mask
    rows, cols = mask.shape
    size = max(round(scale * cols), 1), max(round(scale * rows), 1)
    share = cv2.resize(mask.astype(np.float64), size, interpolation=cv2.INTER_AREA)
    reduced = cv2.resize(light, size, interpolation=cv2.INTER_AREA)
    return np.asarray(reduced / np.maximum(share, 1e-6)), np.asarray(share > 0.5)
