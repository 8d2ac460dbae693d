"""Ground of a bed: heights and brightness of sand, rubble, crust, ripples and dust."""

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Singles
from synth.noise import cells, fractal, stones, wrapped
from synth.spec.bed import BedGround

SIDE = 512  # samples of the periodic tiles along a side
SAMPLES_PER_PX = 2.0  # of theirs, at their natural size
_BANK = 0.45  # share of the stones' swell that filling sand follows
_STONES = ((4, 0.9, 1.0), (8, 0.75, 1.0), (16, 0.45, 0.62))  # grid, share, and size in it


@dataclass(frozen=True, eq=False)
class GroundMaps:
    """Periodic maps of ground, (SIDE, SIDE, 2) each: height (px), and log-brightness."""

    swell: Singles
    sand: Singles
    rubble: Singles
    crust: Singles


@lru_cache(maxsize=8)
def ground_maps(seed: int) -> GroundMaps:
    """Maps from which all grounds of a seed are cut."""
    rng = np.random.default_rng([seed, 12])
    swell = np.stack([fractal(SIDE, 3.3, rng, finest_px=3.0), fractal(SIDE, 2.0, rng)], axis=-1)
    fine, tint = stones(SIDE, 4, 0.95, rng)
    grit, speck = stones(SIDE, 2, 0.8, rng)
    mottle = fractal(SIDE, 1.0, rng)
    sand = np.stack(
        [0.30 * fine / SAMPLES_PER_PX + 0.22 * grit, 0.22 * tint + 0.14 * speck + 0.05 * mottle], -1
    )
    return GroundMaps(
        swell=swell,
        sand=sand.astype(np.float32),
        rubble=_rubble(rng),
        crust=_crust(rng),
    )


def _rubble(rng: np.random.Generator) -> Singles:
    """Stones from one pixel to seven, the larger on the smaller."""
    height = 0.25 * fractal(SIDE, 2.2, rng)
    tint = 0.08 * fractal(SIDE, 1.2, rng)
    for spacing, share, size in _STONES:
        top, own = stones(SIDE, spacing, share, rng, size=size)
        top = top / SAMPLES_PER_PX
        lying = np.where(top > 0.0, cv2.blur(height, (spacing, spacing)) + 0.75 * top, -np.inf)
        above = lying > height
        height = np.where(above, lying, height)
        tint = np.where(above, 0.22 * own, tint)
    return np.stack([height, tint], axis=-1).astype(np.float32)


def _crust(rng: np.random.Generator) -> Singles:
    """Plates of a cracked crust with sand in the cracks, of two sizes."""
    height, tint = 0.2 * fractal(SIDE, 2.6, rng, finest_px=2.0), 0.05 * fractal(SIDE, 1.5, rng)
    bend = 9.0 * np.stack([fractal(SIDE, 3.0, rng), fractal(SIDE, 3.0, rng)], axis=-1)
    line = np.arange(SIDE, dtype=np.float32)
    for spacing, depth in ((64, 1.6), (32, 0.5)):
        near, second, number, _, _ = cells(SIDE, spacing, rng)
        own = 0.05 * rng.standard_normal((SIDE // spacing) ** 2)[number]
        tilt = rng.uniform(-0.5, 0.5, (SIDE // spacing) ** 2)[number]
        stack = np.stack([second - near, own + 0.0 * near, tilt], axis=-1).astype(np.float32)
        places = np.stack(np.meshgrid(line, line), axis=-1) + bend.astype(np.float32)
        stack = wrapped(stack, places[..., 0], places[..., 1])
        gap = stack[..., 0]
        height += depth * np.tanh(gap / 4.0) + stack[..., 2] * (depth / 1.6)
        tint += stack[..., 1] - 0.16 * np.exp(-((gap / 2.0) ** 2))
    return np.stack([height, tint], axis=-1).astype(np.float32)


def make_ground(
    kind: BedGround,
    shape: tuple[int, int],
    *,
    samples_per_px: int,
    relief: float,
    maps: GroundMaps,
    rng: np.random.Generator,
) -> tuple[Singles, Singles]:
    """Heights (px) and log-brightness of a ground, each of `shape`."""
    look = _Looker(shape, samples_per_px, rng)
    swell = look.at(maps.swell, rng.uniform(0.5, 1.2))
    height = relief * rng.uniform(0.8, 2.2) * swell[..., 0]
    tint = rng.uniform(0.03, 0.12) * swell[..., 1]
    if kind == "ripples":
        height += relief * _ripples(shape, samples_per_px, swell[..., 0], rng)
    strengths = {
        "sand": (1.0, 0.0, 0.0),
        "ripples": (0.7, 0.0, 0.0),
        "dust": (0.18, 0.0, 0.0),
        "rubble": (0.3, 1.0, 0.0),
        "crust": (0.35, 0.0, 1.0),
    }[kind]
    for map_, strength, scale in zip(
        (maps.sand, maps.rubble, maps.crust), strengths, (1.3, 1.25, 2.2), strict=True
    ):
        if strength > 0.0:
            size = scale * rng.uniform(0.55, 1.0)
            part = look.at(map_, size)
            height += strength * size * part[..., 0]
            tint += strength * part[..., 1]
    return height, tint


class _Looker:
    """Look-up of periodic maps, each shifted, turned and magnified at random."""

    def __init__(self, shape: tuple[int, int], samples_per_px: int, rng: np.random.Generator):
        self._shape, self._per_px, self._rng = shape, samples_per_px, rng

    def at(self, maps: Singles, size: float) -> Singles:
        turn, shift = self._rng.uniform(0.0, 2.0 * np.pi), self._rng.uniform(0.0, SIDE, 2)
        step = SAMPLES_PER_PX / (self._per_px * size)
        cosine, sine = step * np.cos(turn), step * np.sin(turn)
        rows = np.arange(self._shape[0], dtype=np.float32)[:, None]
        columns = np.arange(self._shape[1], dtype=np.float32)[None, :]
        across = np.float32(cosine) * columns + (np.float32(shift[0]) - np.float32(sine) * rows)
        down = np.float32(sine) * columns + (np.float32(shift[1]) + np.float32(cosine) * rows)
        return wrapped(maps, across, down)


def _ripples(
    shape: tuple[int, int], samples_per_px: int, swell: Singles, rng: np.random.Generator
) -> Singles:
    """Sand ripples, px: crests that wander, with a steeper lee side."""
    length_px = rng.uniform(14.0, 60.0)
    turn = rng.uniform(0.0, 2.0 * np.pi)
    rows = np.arange(shape[0], dtype=np.float32)[:, None] / np.float32(samples_per_px)
    columns = np.arange(shape[1], dtype=np.float32)[None, :] / np.float32(samples_per_px)
    wave = np.float32(2.0 * np.pi / length_px)
    phase = wave * (np.float32(np.cos(turn)) * columns + np.float32(np.sin(turn)) * rows)
    phase = phase + np.float32(rng.uniform(0.4, 1.1)) * swell
    height = np.sin(phase + np.float32(0.45) * np.sin(phase))
    return np.asarray(np.float32(length_px * rng.uniform(0.025, 0.05)) * height)


def fill(height_px: Singles, grain: NDArray[np.int32], ground_px: Singles, level: float) -> Singles:
    """Fill a bed in place with sand up to a share of its relief, banked up where stones are.

    The sand has the ground's own roughness; what it covers becomes ground. Returned are the
    heights of the sand, also where it does not reach the surface.
    """
    low, high = np.percentile(height_px[::4, ::4], [2.0, 98.0])
    rows, columns = height_px.shape
    small = cv2.resize(height_px, (columns // 4, rows // 4), interpolation=cv2.INTER_AREA)
    soft = cv2.resize(cv2.GaussianBlur(small, (0, 0), 3.0), (columns, rows))
    sand = np.float32(low + level * (high - low) - ground_px.mean()) + ground_px
    sand += np.float32(_BANK) * (soft - np.float32(soft.mean()))
    covered = sand > height_px
    height_px[covered] = sand[covered]
    grain[covered] = 0
    return sand
