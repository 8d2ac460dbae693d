"""Light on a height field: normals, cast shadows and the share of the sky that is seen."""

import cv2
import numpy as np

from synth.arrays import Singles

_SKY_STEPS = (1, 2, 4, 8, 16)  # distances at which the sky's horizon is looked for, in samples
_SKY_DIRECTIONS = 8


def normals_of(height_px: Singles, per_px: int) -> Singles:
    """Unit normals (rows, cols, 3) along columns, rows and towards the camera."""
    scale = per_px / 2.0
    kernel = np.array([-1.0, 0.0, 1.0], dtype=np.float32) * np.float32(scale)
    one = np.ones(1, dtype=np.float32)
    border = cv2.BORDER_REPLICATE
    right = cv2.sepFilter2D(height_px, cv2.CV_32F, kernel, one, borderType=border)
    below = cv2.sepFilter2D(height_px, cv2.CV_32F, one, kernel, borderType=border)
    up = 1.0 / np.sqrt(1.0 + right * right + below * below)
    return np.stack([-right * up, -below * up, up], axis=-1)


def shadow_depth(
    height_px: Singles, per_px: int, *, azimuth_rad: float, elevation_rad: float
) -> Singles:
    """Depth of each sample below the surface that its shadow casters' rays graze, px; 0 in light.

    Rays run over the samples along the sun's direction in plan, one sample further in the longer
    of its two components at each step and sideways by rounding; along them the highest ray so far
    is carried on: shadows of any length cost the same.
    """
    east, south = np.cos(azimuth_rad), np.sin(azimuth_rad)
    turned = abs(east) > abs(south)
    field = height_px.T if turned else height_px
    ahead, aside = (east, south) if turned else (south, east)  # towards the sun
    if ahead > 0.0:
        field = field[::-1]
    shift = aside / abs(ahead)
    drop = np.float32(np.hypot(1.0, shift) * np.tan(elevation_rad) / per_px)
    lines, width = field.shape
    # The sun lies in the direction of falling lines: ray k of line i stands at column
    # k − round(i × shift), so that one step away from the sun keeps k.
    moves = np.rint(np.arange(lines) * shift).astype(int)
    first, last = int(moves.min()), int(moves.max())
    ray = np.full(width + last - first, -np.inf, dtype=np.float32)
    depth = np.empty((lines, width), dtype=np.float32)
    for line in range(lines):
        start = int(moves[line]) - first
        here = ray[start : start + width]
        np.subtract(here, field[line], out=depth[line])
        np.maximum(here, field[line], out=here)
        ray -= drop
    np.maximum(depth, 0.0, out=depth)
    if ahead > 0.0:
        depth = depth[::-1]
    return np.ascontiguousarray(depth.T if turned else depth)


def sky_share(height_px: Singles, per_px: int) -> Singles:
    """Share of a sky of even light that level ground would get at each sample, 0 to 1.

    In each of eight directions the horizon is the steepest rise to a few distances; the share is
    the mean of the squared cosine of its elevation.
    """
    rows, columns = height_px.shape
    small = height_px
    factor = 1
    if per_px > 1:
        factor = 2
        half = (columns // 2, rows // 2)
        small = np.asarray(cv2.resize(height_px, half, interpolation=cv2.INTER_AREA), np.float32)
    reach = max(_SKY_STEPS)
    wide = cv2.copyMakeBorder(small, reach, reach, reach, reach, cv2.BORDER_REPLICATE)
    spacing = factor / per_px
    total = np.zeros_like(small)
    height, width = small.shape
    for index in range(_SKY_DIRECTIONS):
        angle = 2.0 * np.pi * index / _SKY_DIRECTIONS
        steepest = np.zeros_like(small)
        for step in _SKY_STEPS:
            right, below = round(step * np.cos(angle)), round(step * np.sin(angle))
            if right == 0 and below == 0:
                continue
            length = np.float32(1.0 / (spacing * np.hypot(right, below)))
            shifted = wide[
                reach + below : reach + below + height, reach + right : reach + right + width
            ]
            np.maximum(steepest, (shifted - small) * length, out=steepest)
        total += 1.0 / (1.0 + steepest * steepest)
    total *= np.float32(1.0 / _SKY_DIRECTIONS)
    if factor > 1:
        total = np.asarray(cv2.resize(total, (columns, rows)), dtype=np.float32)
    return total
