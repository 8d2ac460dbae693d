"""What rises above the ground: heights in units of their own noise, and the regions that stand."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.ground import Ground, NoiseModel
from rockshape.numerics.arrays import Mask, Singles

FOOT_SIGMA = 2.5  # a rock begins this many standard deviations above the ground
STAND_SIGMA = 5.0  # and somewhere it stands this many above it,
STAND_PIXELS = 12  # on so many pixels: noise is even over a matching window of about seven
MIN_PIXELS = 40  # a rock of seven pixels across
MEDIAN_PX = 5


@dataclass(frozen=True, eq=False)
class HeightSignal:
    """Heights above the ground and what they mean; all (rows, cols)."""

    height_m: Singles  # 0 where nothing was measured
    depth_m: Singles  # z-depth, 0 where nothing was measured
    sigma_m: Singles  # standard deviation of the ground's height there
    depth_sd_m: Singles  # standard deviation of the z-depth
    signal: Singles  # height over sigma, smoothed by a median; 0 where nothing was measured
    known: Mask
    pixel_rad: float  # a pixel's angle
    fine: bool  # whether range is exact beside its pixels, and its edges the rocks'


def relief_of(points_m: NDArray[np.float64], ground: Ground, noise: NoiseModel) -> HeightSignal:
    """Heights of points (rows, cols, 3), NaN where unknown, in units of the noise there.

    The noise of a height is the ground's: its roughness, and the range's, which grows with the
    square of the distance. The signal is smoothed by a median over 5 x 5 pixels, which leaves
    edges where they are but takes off corners: not where range is fine.
    """
    depth = points_m[..., 2].astype(np.float32)
    height = ground.height_m(points_m).astype(np.float32)
    known = np.isfinite(height) & (depth > 0)
    height[~known], depth[~known] = 0.0, 0.0
    above = np.abs(height + np.float32(ground.plane.offset_m))
    with np.errstate(divide="ignore", invalid="ignore"):
        sigma = noise.height_sd_m(depth, np.where(known, above / depth, 0)).astype(np.float32)
    sigma[~known] = 1.0
    fine = bool(known.any()) and noise.is_fine(float(np.median(depth[known])))
    signal = height / sigma if fine else cv2.medianBlur(height / sigma, MEDIAN_PX)
    signal[~known] = 0.0
    return HeightSignal(
        height_m=height,
        depth_m=depth,
        sigma_m=sigma,
        depth_sd_m=noise.depth_sd_m(depth).astype(np.float32),
        signal=np.asarray(signal, np.float32),
        known=known,
        pixel_rad=noise.pixel_rad,
        fine=fine,
    )


def standing(relief: HeightSignal) -> Mask:
    """Pixels of regions that stand on the ground, (rows, cols).

    A region is 4-connected, begins 2.5 standard deviations above the ground, has 40 pixels and 12
    of them 5 standard deviations above it. What it encloses is part of it.
    """
    low: NDArray[np.integer] = (relief.signal > FOOT_SIGMA).astype(np.uint8)
    if not relief.fine:
        cross = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))
        low = np.asarray(cv2.morphologyEx(low, cv2.MORPH_OPEN, cross))
    count, regions, stats, _ = cv2.connectedComponentsWithStats(low, connectivity=4)
    high = np.bincount(regions[relief.signal > STAND_SIGMA], minlength=count)
    good = (high >= STAND_PIXELS) & (stats[:, cv2.CC_STAT_AREA] >= MIN_PIXELS)
    good[0] = False
    return fill_holes(good[regions])


def fill_holes(mask: Mask) -> Mask:
    """The mask with what it encloses, by 4-connection of what is outside."""
    rows, cols = mask.shape
    outside = np.zeros((rows + 2, cols + 2), dtype=np.uint8)
    outside[1:-1, 1:-1] = mask
    cv2.floodFill(outside, None, (0, 0), 2)
    return np.asarray(outside[1:-1, 1:-1] != 2)
