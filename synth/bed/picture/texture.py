"""Textures of rocks: periodic maps, looked up in each rock's own frame."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles
from synth.noise import cells, fractal, wrapped

SIDE = 512  # samples of the maps along a side
PER_PX = 2.0  # of them in a pixel, on a rock of 30 px
MOTTLE, GRAIN, RELIEF, PATTERN = range(4)  # channels of the maps
_PATTERNS = ("bands", "veins", "stains", "crystals", "pits")


@lru_cache(maxsize=8)
def texture_maps(seed: int) -> dict[str, Singles]:
    """Periodic maps (SIDE, SIDE, 4) by pattern: mottle, grain, relief and the pattern itself.

    All are of zero mean and unit variance, or nearly.
    """
    rng = np.random.default_rng([seed, 13])
    mottle, grain = fractal(SIDE, 2.4, rng), fractal(SIDE, 0.9, rng)
    relief = fractal(SIDE, 2.3, rng, finest_px=1.0)
    warp, fine = fractal(SIDE, 3.0, rng), fractal(SIDE, 2.2, rng)
    line = np.arange(SIDE) / SIDE
    phase = 2.0 * np.pi * (9.0 * line[:, None] + 2.0 * line[None, :]) + 1.6 * warp
    bands = np.sin(phase) + 0.6 * np.sin(2.7 * phase + fine) + 0.5 * fine
    veins = np.exp(-np.abs(warp + 0.12 * fine) / 0.05) * (
        0.6 + 0.4 * np.sign(fractal(SIDE, 3, rng))
    )
    stains = np.tanh(5.0 * (fractal(SIDE, 2.7, rng) - 0.45))
    _, _, number, _, _ = cells(SIDE, 4, rng)
    crystals = rng.standard_normal((SIDE // 4) ** 2)[number] + 0.7 * np.tanh(
        4.0 * (fractal(SIDE, 1.2, rng) - 1.0)
    )
    pits = _pits(rng)
    patterns = dict(zip(_PATTERNS, (bands, veins, stains, crystals, pits), strict=True))
    return {
        name: np.stack([mottle, grain, relief, _standard(pattern)], -1).astype(np.float32)
        for name, pattern in patterns.items()
    }


def _pits(rng: np.random.Generator) -> Singles:
    """Pits of ragged outline and of very unequal sizes, as depths below 0."""
    ragged = 1.0 + 0.35 * fractal(SIDE, 2.0, rng, finest_px=1.5)
    depth = np.zeros((SIDE, SIDE), dtype=np.float32)
    for spacing, share in ((8, 0.35), (16, 0.3), (32, 0.3)):
        near, _, number, right, below = cells(SIDE, spacing, rng)
        count = (SIDE // spacing) ** 2
        radius = np.where(rng.uniform(size=count) < share, spacing * rng.beta(1.5, 4.0, count), 0.0)
        oval = near * ragged + 0.3 * np.abs(right + below)
        part = 1.0 - (oval / np.maximum(radius[number], 1e-3)) ** 2
        depth = np.maximum(depth, np.sqrt(np.maximum(part, 0.0)) * np.sqrt(radius[number]))
    return -depth


def _standard(field: NDArray[np.floating]) -> Singles:
    return np.asarray((field - field.mean()) / field.std(), dtype=np.float32)


def textures(
    grain: NDArray[np.int32], frames: Singles, maps: Singles, *, per_px: int, margin_px: int
) -> Singles:
    """Values of the maps (rows, cols, 4) on the rocks, each in its own frame.

    `frames` (n, 6) takes places in the tile to places in the maps; row 0 is the ground's.
    """
    rows, columns = grain.shape
    x = np.arange(columns, dtype=np.float32)[None, :] / np.float32(per_px) - np.float32(margin_px)
    y = np.arange(rows, dtype=np.float32)[:, None] / np.float32(per_px) - np.float32(margin_px)
    f = [np.ascontiguousarray(part)[grain] for part in frames.T]
    return wrapped(maps, f[0] * x + (f[1] * y + f[2]), f[3] * x + (f[4] * y + f[5]))
