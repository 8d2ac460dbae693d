"""Albedo texture: noise with equal power in every octave, finer than the camera's pixels."""

from functools import cache

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles
from synth.noise import halved

_SIZE = 1024  # texels of the tile's side
TEXEL_M = 0.002
_LONGEST = 64  # texels of the longest wave: shorter than the tile, or its repetition would show
_LEVELS = 8
_COARSER = 7.3  # the tile is laid a second time, this much larger
_COARSER_OCTAVES = 3
_TURN_RAD = 0.6  # and turned, so that the two never repeat together
_ROW = 1 << 12  # cv2.remap takes images, so long lists of places are folded into rows


@cache
def pyramid() -> tuple[Singles, ...]:
    """Tile, (1025, 1025), mean 0 and variance 1, and its halvings down to 8 texels.

    Its spectrum falls as 1/f² between 64 and 2 texels, which is equal power in each octave: at
    whatever distance, the pixels find contrast at their own scale and at the coarser ones. The
    first row and column are repeated at the end, so that interpolation can cross the seam.
    """
    rng = np.random.default_rng(20020309)
    waves = np.fft.fftfreq(_SIZE)
    length = np.hypot(waves[:, None], waves[None, : _SIZE // 2 + 1])
    amplitude = np.where(length >= 1.0 / _LONGEST, 1.0 / np.maximum(length, 1e-9), 0.0)
    spectrum = amplitude * np.fft.rfft2(rng.standard_normal((_SIZE, _SIZE)))
    tile = np.fft.irfft2(spectrum, s=(_SIZE, _SIZE))
    levels = [(tile / tile.std()).astype(np.float32)]
    for _ in range(_LEVELS - 1):
        levels.append(halved(levels[-1]))
    return tuple(np.pad(level, (0, 1), mode="wrap") for level in levels)


def pattern(across_m: Singles, along_m: Singles, footprint_m: Singles) -> Singles:
    """Texture at places of a plane, (n,), variance 1 where the pixels are small.

    footprint_m (n,) is a pixel's side on the surface: what is finer is averaged out beforehand.
    """
    cosine, sine = np.float32(np.cos(_TURN_RAD)), np.float32(np.sin(_TURN_RAD))
    scale = np.float32(1.0 / TEXEL_M)
    octave = np.rint(np.log2(np.maximum(footprint_m * scale, 1.0))).astype(np.int8)
    fine = _tile(across_m * scale, along_m * scale, np.minimum(octave, _LEVELS - 1))
    scale = np.float32(1.0 / (TEXEL_M * _COARSER))
    coarse = _tile(
        (cosine * across_m - sine * along_m) * scale,
        (sine * across_m + cosine * along_m) * scale,
        np.clip(octave - _COARSER_OCTAVES, 0, _LEVELS - 1),
    )
    return np.asarray(np.float32(0.95) * fine + np.float32(0.3) * coarse)


def plane_weights(normals: Singles) -> Singles:
    """Weights (n, 3) of the patterns of three planes on surfaces with normals (n, 3).

    The normal's components to the fourth power, divided by the root of their squares' sum, so that
    the variance holds where the patterns mix.
    """
    weights = normals**4
    weights /= np.sqrt((weights**2).sum(axis=1, keepdims=True))
    return np.asarray(weights)


def wrapped(points_m: Singles, normals: Singles, footprint_m: Singles) -> Singles:
    """Texture of a body at points (n, 3) of its own frame with normals (n, 3)."""
    weights = plane_weights(normals)
    total = np.zeros(len(points_m), dtype=np.float32)
    for axis in range(3):
        shown = np.flatnonzero(weights[:, axis] > 0.05)
        one, two = points_m[shown, (axis + 1) % 3], points_m[shown, (axis + 2) % 3]
        total[shown] += weights[shown, axis] * pattern(
            one + np.float32(0.31 * axis), two, footprint_m[shown]
        )
    return total


def _tile(u: Singles, v: Singles, level: NDArray[np.int8]) -> Singles:
    """Tile at places in texels, each from its level."""
    found = np.empty(len(u), dtype=np.float32)
    counts = np.bincount(level, minlength=_LEVELS)
    for number in np.flatnonzero(counts):
        here = slice(None) if counts[number] == len(u) else np.flatnonzero(level == number)
        shrink = np.float32(0.5**number)
        found[here] = _lookup(pyramid()[number], u[here] * shrink, v[here] * shrink)
    return found


def _lookup(tile: Singles, u: Singles, v: Singles) -> Singles:
    """Tile between its texels, (n,), repeated without end."""
    size = np.float32(len(tile) - 1)
    rows = -(-len(u) // _ROW)
    maps = []
    for coordinate in (u, v):
        place = np.zeros(rows * _ROW, dtype=np.float32)
        place[: len(u)] = coordinate - np.floor(coordinate / size) * size
        maps.append(place.reshape(rows, _ROW))
    found = cv2.remap(tile, maps[0], maps[1], cv2.INTER_LINEAR)
    return np.asarray(found.ravel()[: len(u)], dtype=np.float32)
