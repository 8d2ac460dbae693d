"""Periodic random fields: fractal noise, cells and stones on a square that repeats itself.

Grounds of scenes, gravel beds and the textures of their grains are made of them.
"""

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy import fft

from synth.arrays import Singles

Field = Singles  # (side, side), both edges join

_LEAST_SIDE = 8  # of the coarsest halving
_ROW = 1 << 12  # cv2.remap takes images, so long lists of places are folded into rows


def fractal(
    side: int,
    slope: float,
    rng: np.random.Generator,
    *,
    finest_px: float = 0.0,
    longest_px: float = np.inf,
) -> Field:
    """Gaussian field of zero mean and unit variance whose power falls as frequency^−slope.

    Waves shorter than `finest_px` or longer than `longest_px` are left out.
    """
    down = fft.fftfreq(side)[:, None]
    across = fft.rfftfreq(side)[None, :]
    frequency = np.hypot(down, across)
    frequency[0, 0] = np.inf
    gain = frequency ** (-slope / 2.0)
    if finest_px > 0.0:
        gain *= np.exp(-((frequency * finest_px) ** 2))
    gain[0, 0] = 0.0
    gain[frequency < 1.0 / longest_px] = 0.0
    white = fft.rfft2(rng.standard_normal((side, side)))
    field = fft.irfft2(white * gain, s=(side, side))
    return np.asarray(field / field.std(), dtype=np.float32)


def cells(
    side: int, spacing: int, rng: np.random.Generator
) -> tuple[Field, Field, NDArray[np.int32], Field, Field]:
    """Voronoi cells of one random point in each square of a grid; `spacing` divides `side`.

    Returns the distances to the nearest and the second nearest point (px), the cell's number, and
    the offsets from its point along columns and rows (px).
    """
    count = side // spacing
    places = (rng.uniform(0.0, 1.0, (count, count, 2)) * spacing).astype(np.float32)
    line = np.arange(side, dtype=np.int64)
    square, rest = line // spacing, (line % spacing).astype(np.float32)
    best = np.full((side, side), np.inf, dtype=np.float32)
    second = best.copy()
    number = np.zeros((side, side), dtype=np.int32)
    right, below = np.zeros_like(best), np.zeros_like(best)
    for down in (-1, 0, 1):
        rows = (square + down) % count
        for along in (-1, 0, 1):
            columns = (square + along) % count
            point = places[rows[:, None], columns[None, :]]
            dx = rest[None, :] - (point[..., 0] + along * spacing)
            dy = rest[:, None] - (point[..., 1] + down * spacing)
            distance = np.hypot(dx, dy)
            nearer = distance < best
            second = np.where(nearer, best, np.minimum(second, distance))
            best = np.where(nearer, distance, best)
            number = np.where(nearer, (rows[:, None] * count + columns).astype(np.int32), number)
            right, below = np.where(nearer, dx, right), np.where(nearer, dy, below)
    return best, second, number, right, below


def stones(
    side: int, spacing: int, share: float, rng: np.random.Generator, *, size: float = 1.0
) -> tuple[Field, Field]:
    """Small stones in the squares of a grid: heights of their tops (px) and a tint for each.

    Each is a tilted half-ellipsoid with a facet or two, in a share of the squares; the height is
    0 and the tint 0 between them. The tint has unit variance.
    """
    _, _, number, right, below = cells(side, spacing, rng)
    count = (side // spacing) ** 2
    long_px = (size * spacing * rng.uniform(0.32, 0.62, count)).astype(np.float32)
    short_px = long_px * rng.uniform(0.5, 0.95, count).astype(np.float32)
    turn = rng.uniform(0.0, np.pi, count)
    cosine, sine = np.cos(turn).astype(np.float32), np.sin(turn).astype(np.float32)
    flat = rng.uniform(0.45, 0.9, count).astype(np.float32) * short_px
    there = rng.uniform(size=count) < share
    slope = rng.uniform(-0.35, 0.35, (2, count)).astype(np.float32)
    power = rng.uniform(2.0, 4.0, count).astype(np.float32)
    u = (right * cosine[number] + below * sine[number]) / long_px[number]
    v = (below * cosine[number] - right * sine[number]) / short_px[number]
    gauge = np.abs(u) ** power[number] + np.abs(v) ** power[number]
    dome = flat[number] * np.sqrt(np.maximum(1.0 - gauge, 0.0))
    dome *= 1.0 + slope[0][number] * u + slope[1][number] * v
    here = (gauge < 1.0) & there[number]
    height = np.where(here, np.maximum(dome, 0.0), 0.0)
    tint = np.where(here, rng.standard_normal(count)[number], 0.0)
    return height.astype(np.float32), tint.astype(np.float32)


def wrapped(maps: Field, columns: Field, rows: Field) -> Field:
    """Periodic maps at places, linear between samples."""
    return np.asarray(
        cv2.remap(maps, columns, rows, cv2.INTER_LINEAR, borderMode=cv2.BORDER_WRAP),
        dtype=np.float32,
    )


def halved(maps: Field) -> Field:
    """Periodic maps of half the side, each sample the mean of four."""
    return np.asarray(
        (maps[::2, ::2] + maps[1::2, ::2] + maps[::2, 1::2] + maps[1::2, 1::2]) * np.float32(0.25)
    )


def slopes(height: Field) -> Field:
    """Slopes of a periodic map along columns and rows, (side, side, 2), by central differences."""
    return np.stack(
        [(np.roll(height, -1, axis) - np.roll(height, 1, axis)) / 2 for axis in (1, 0)], axis=-1
    )


class MipMap:
    """Periodic maps with their halvings, to be looked up averaged over a footprint."""

    def __init__(self, maps: Field) -> None:
        """Take maps (side, side) or (side, side, channels), at most four; side is a power of 2."""
        self._levels = [np.ascontiguousarray(maps, dtype=np.float32)]
        while len(self._levels[-1]) > _LEAST_SIDE:
            self._levels.append(halved(self._levels[-1]))

    def mean(self) -> Singles:
        """Means of the maps, (channels,)."""
        return np.asarray(self._levels[-1].mean(axis=(0, 1)))

    def at(self, columns: Singles, rows: Singles, footprint: Singles) -> Singles:
        """Maps at places (n,) in samples, as (n,) or (n, channels), linear between samples.

        footprint (n,) is the side, in samples, of the square that each value stands for.
        """
        level = np.rint(np.log2(np.maximum(footprint, 1.0))).astype(np.int64)
        level = np.minimum(level, len(self._levels) - 1)
        found = np.empty((len(columns), *self._levels[0].shape[2:]), dtype=np.float32)
        for number in np.unique(level):
            here = np.flatnonzero(level == number)
            maps, shrink = self._levels[number], 0.5**number
            found[here] = _folded(
                maps,
                (columns[here] + 0.5) * shrink - 0.5,
                (rows[here] + 0.5) * shrink - 0.5,
            )
        return found


def _folded(maps: Field, columns: Singles, rows: Singles) -> Singles:
    """Periodic maps at long lists of places, folded into the rows of an image for OpenCV."""
    count = -(-len(columns) // _ROW)
    places = np.zeros((2, count * _ROW), dtype=np.float32)
    for place, coordinate in zip(places, (columns, rows), strict=True):
        place[: len(columns)] = coordinate % len(maps)
    across, down = places.reshape(2, count, _ROW)
    seen = wrapped(maps, across, down)
    return np.asarray(seen.reshape(count * _ROW, *maps.shape[2:])[: len(columns)])
