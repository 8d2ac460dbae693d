"""Layers of a field's ground: fractal relief, crust, outcrop and drifts, as periodic maps."""

from dataclasses import dataclass

import cv2
import numpy as np

from synth.arrays import Singles
from synth.noise import cells, fractal, wrapped
from synth.spec.terrain import TerrainSpec

SIDE = 2048  # samples of the maps along a side
_PERIODS = 4.0  # the maps are so many times as wide as their longest wave
_SOFT = 4  # smooth maps are made on so many times fewer samples
_EDGE = 0.18  # share of a layer's thickness over which its edge falls
_JOINT = 0.04  # width of joints and cracks over the distance between them
_RIPPLES = 0.09  # length of the ripples on drifts, m
FEATHER_M = 0.015  # thickness of a drift that hides what is below
_SMOOTH_SLOPE = 4.0  # of the swell of drifts
_BEDS_SLOPE = 3.4  # of the surface that the outcrop's layers are cut from


@dataclass(frozen=True, eq=False)
class Layers:
    """Maps of a field, (SIDE, SIDE), both edges join."""

    cell_m: float  # between samples
    height_m: Singles
    drift: Singles  # 1 where drifted dust lies, 0 elsewhere
    bedrock: Singles  # 1 where bedrock is bare
    crack: Singles  # 1 in cracks and joints


def make_layers(spec: TerrainSpec, rng: np.random.Generator) -> Layers:
    """Layers of a field, one upon another: what lies higher covers what is below.

    The relief has the power spectrum C f^−slope between its longest wave and two samples, and the
    RMS height asked for. Bedrock comes out where it stands above the soil, drifts fill what lies
    below theirs; both take the share of the ground asked for.
    """
    cell_m = _PERIODS * spec.relief_length_m / SIDE
    relief, beds, swell, plates = rng.spawn(4)
    height = np.float32(spec.relief_rms_m) * fractal(
        SIDE, spec.relief_slope, relief, longest_px=SIDE / _PERIODS
    )
    bedrock, drift, crack = (np.zeros((SIDE, SIDE), dtype=np.float32) for _ in range(3))
    if spec.crust > 0.0:
        gap_m, tilt, _ = _plates(spec.crust_plate_m, cell_m, plates)
        there = _patches(spec.crust, plates)
        width_m = _JOINT * spec.crust_plate_m
        crack = there * np.exp(-((gap_m / width_m) ** 2))
        height += np.float32(spec.crust_depth_m) * (0.3 * there * tilt - crack)
    if spec.outcrop > 0.0:
        stone, joint = _outcrop(spec, cell_m, beds)
        stone += _level(height - stone, spec.outcrop)
        bedrock = _above(stone - height, 0.05 * spec.outcrop_layer_m)
        crack = np.where(bedrock > 0.5, joint, crack)
        height = np.maximum(height, stone)
    if spec.drift > 0.0:
        sand = np.float32(spec.drift_height_m) * _soft(_SMOOTH_SLOPE, swell)
        sand += _ripples(spec.drift_ripple_m, cell_m, sand / spec.drift_height_m)
        sand += _level(height - sand, spec.drift)
        drift = _above(sand - height, FEATHER_M)
        height, crack = np.maximum(height, sand), crack * (1.0 - drift)
        bedrock = bedrock * (1.0 - drift)
    return Layers(cell_m, height, drift, bedrock, crack)


def _level(gap_m: Singles, share: float) -> np.float32:
    """Shift that lifts a surface above another on a share of the ground."""
    return np.float32(np.quantile(gap_m[::_SOFT, ::_SOFT], share))


def _above(thickness_m: Singles, soft_m: float) -> Singles:
    """Cover of an upper surface: 0 where it lies below, rising to 1 over a thickness."""
    return np.asarray((thickness_m / np.float32(soft_m)).clip(0.0, 1.0), dtype=np.float32)


def _soft(slope: float, rng: np.random.Generator) -> Singles:
    """Smooth field of unit variance."""
    small = fractal(SIDE // _SOFT, slope, rng, finest_px=4.0, longest_px=SIDE / _SOFT / _PERIODS)
    line = ((np.arange(SIDE, dtype=np.float32) + 0.5) / _SOFT - 0.5) % len(small)
    columns, rows = (np.float32(one) for one in np.meshgrid(line, line))
    return wrapped(small, np.asarray(columns), np.asarray(rows))


def _patches(share: float, rng: np.random.Generator) -> Singles:
    """Patches with soft edges on a share of the ground."""
    field = _soft(3.2, rng)
    return _above(field - np.float32(np.quantile(field[::8, ::8], 1.0 - share)), 0.15)


def _plates(
    spacing_m: float, cell_m: float, rng: np.random.Generator
) -> tuple[Singles, Singles, Singles]:
    """Polygonal plates: distance from the crack (m), and the tilt and rise of each plate."""
    side, sample_m = SIDE // 2, 2.0 * cell_m
    wanted = max(int(np.log2(spacing_m / sample_m)), 2)
    spacing = min(2 ** (wanted + int(spacing_m / sample_m / 2**wanted > 1.41)), side // 4)
    near, second, number, right, below = cells(side, spacing, rng)
    count = (side // spacing) ** 2
    tilts = rng.uniform(-1.0, 1.0, (3, count)).astype(np.float32)
    tilt = (tilts[0][number] * right + tilts[1][number] * below) / np.float32(spacing)
    stack = np.stack([(second - near) / 2.0, tilt, tilts[2][number]], axis=-1)
    bend = 0.22 * spacing * np.stack([_soft(2.6, rng), _soft(2.6, rng)], axis=-1)
    line = np.arange(SIDE, dtype=np.float32) / 2.0
    grid = np.stack(np.meshgrid(line, line), axis=-1)
    places = np.asarray((grid + bend) % side, dtype=np.float32)
    bent = wrapped(stack.astype(np.float32), places[..., 0], places[..., 1])
    scale = np.float32(spacing_m / spacing)
    return bent[..., 0] * scale, bent[..., 1], bent[..., 2]


def _outcrop(spec: TerrainSpec, cell_m: float, rng: np.random.Generator) -> tuple[Singles, Singles]:
    """Layered bedrock: heights (m) in steps, cut by joints into blocks, and the joints."""
    gap_m, tilt, rise = _plates(spec.outcrop_block_m, cell_m, rng)
    layer_m = np.float32(spec.outcrop_layer_m)
    layers = 1.6 * _soft(_BEDS_SLOPE, rng) + 0.35 * rise
    layers += 0.05 * fractal(SIDE, 2.2, rng, longest_px=SIDE / 8)
    whole = np.floor(layers)
    edge = ((layers - whole - (1.0 - _EDGE)) / _EDGE).clip(0.0, 1.0)
    joint = np.exp(-((gap_m / (_JOINT * spec.outcrop_block_m)) ** 2))
    grain = 0.06 * fractal(SIDE, 2.4, rng, longest_px=SIDE / 16)
    height = layer_m * (whole + edge + 0.25 * tilt + grain - 0.8 * joint)
    return np.asarray(height, dtype=np.float32), np.asarray(joint, dtype=np.float32)


def _ripples(height_m: float, cell_m: float, swell: Singles) -> Singles:
    """Wind ripples whose crests bend with the swell and fade in its hollows."""
    waves = round(SIDE * cell_m / _RIPPLES)
    line = np.float32(2.0 * np.pi / SIDE) * np.arange(SIDE, dtype=np.float32)
    phase = waves * line[None, :] + (waves // 4) * line[:, None] + 3.0 * cv2.blur(swell, (9, 9))
    strength = (0.5 + 0.5 * swell).clip(0.0, 1.0)
    ripples = np.sin(phase + 0.4 * np.sin(phase))
    return np.asarray(np.float32(height_m / 2.0) * strength * ripples, dtype=np.float32)
