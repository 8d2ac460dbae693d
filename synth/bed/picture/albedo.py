"""Reflectance of a bed: rock types, the looks of single rocks, ground and dust."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats, Singles
from synth.bed.picture.texture import GRAIN, MOTTLE, PATTERN, PER_PX, SIDE
from synth.spec.bed import Palette


@dataclass(frozen=True)
class _Colours:
    """Linear reflectances: rock types with their shares, and the ground's."""

    rocks: tuple[tuple[float, float, float, float], ...]  # share, red, green, blue
    ground: tuple[float, float, float]


_PALETTES: dict[str, _Colours] = {
    "river": _Colours(
        (
            (0.45, 0.250, 0.262, 0.285),
            (0.20, 0.155, 0.158, 0.165),
            (0.18, 0.340, 0.285, 0.200),
            (0.07, 0.300, 0.215, 0.170),
            (0.10, 0.560, 0.550, 0.500),
        ),
        (0.360, 0.305, 0.205),
    ),
    "limestone": _Colours(
        (
            (0.50, 0.420, 0.415, 0.390),
            (0.30, 0.350, 0.335, 0.290),
            (0.12, 0.300, 0.260, 0.210),
            (0.08, 0.230, 0.230, 0.230),
        ),
        (0.300, 0.275, 0.225),
    ),
    "mars": _Colours(
        (
            (0.45, 0.230, 0.195, 0.130),
            (0.30, 0.330, 0.235, 0.130),
            (0.25, 0.170, 0.150, 0.110),
        ),
        (0.390, 0.245, 0.115),
    ),
    "basalt": _Colours(
        (
            (0.60, 0.105, 0.103, 0.102),
            (0.25, 0.150, 0.142, 0.135),
            (0.15, 0.200, 0.160, 0.130),
        ),
        (0.170, 0.155, 0.140),
    ),
}


@dataclass(frozen=True, eq=False)
class RockLook:
    """Looks of a bed's rocks; row 0 of each array is the ground's and unused."""

    colour: Singles  # (n, 3), linear reflectance
    weights: Singles  # (n, 4): mottle, grain and pattern in log-brightness, warmth of the pattern
    relief_px: Singles  # (n, 2): RMS of fine relief, and of the pattern's
    frame: Singles  # (n, 6): places in the tile to places in the maps, row by row


def draw_colours(palette: Palette, rng: np.random.Generator) -> tuple[Floats, Floats, Floats]:
    """Shares (k,) and colours (k, 3) of a tile's rock types, and the ground's colour (3,)."""
    if palette == "mixed":
        count = int(rng.integers(2, 6))
        grey = np.exp(rng.uniform(np.log(0.1), np.log(0.5), (count + 1, 1)))
        warm = rng.uniform(-0.12, 0.45, (count + 1, 1)) * rng.uniform(0.0, 1.0, (count + 1, 1))
        colours = grey * np.exp(warm * [0.45, 0.05, -0.7]) * _tinge(0.0, rng)
        shares = rng.dirichlet(np.full(count, 1.2))
        return shares, colours[1:], colours[0]
    chosen = _PALETTES[palette]
    table = np.array(chosen.rocks)
    shares = table[:, 0] * rng.gamma(2.0, 0.5, len(table))
    return (
        shares / shares.sum(),
        table[:, 1:] * _tinge(0.16, rng),
        np.array(chosen.ground) * _tinge(0.2, rng),
    )


def _tinge(spread: float, rng: np.random.Generator) -> Floats:
    """Factor (3,) of random brightness, warmth and, less, greenness."""
    bright, warm, green = rng.standard_normal(3)
    return np.asarray(
        np.exp(spread * bright + 0.05 * warm * np.array([1.0, 0.1, -1.3]))
        * np.exp(0.012 * green * np.array([-0.5, 1.0, -0.5]))
    )


def draw_looks(
    widths_px: Floats,
    centres_px: Floats,
    roughness: Floats,
    colours: tuple[Floats, Floats, Floats],
    rng: np.random.Generator,
) -> RockLook:
    """Looks of grains of some widths and places (n,), (n, 2), for one pattern a tile."""
    count = len(widths_px)
    shares, types, ground = colours
    kind = rng.choice(len(shares), size=count, p=shares)
    colour = types[kind] * np.exp(0.17 * rng.standard_normal((count, 1)))
    colour *= np.exp(0.035 * rng.standard_normal((count, 1)) * [1.0, 0.1, -1.4])
    busy = rng.gamma(2.0, 0.5, (count, 4)) * rng.uniform(0.4, 1.4)
    weights = busy * [0.15, 0.07, 0.13, 0.10]
    weights[:, 2] *= rng.uniform(size=count) < 0.6
    weights[:, 3] *= np.sign(rng.uniform(-0.4, 1.0, count))
    relief = np.column_stack(
        [0.036 * roughness * widths_px**0.75, 0.012 * widths_px**0.75 * busy[:, 2]]
    )
    relief *= rng.uniform(0.5, 1.3)
    turn = rng.uniform(0.0, 2.0 * np.pi, count)
    size = PER_PX * rng.uniform(0.7, 1.5, count) * (30.0 / widths_px) ** 0.45  # samples a pixel
    cosine, sine = size * np.cos(turn), size * np.sin(turn)
    shift = rng.uniform(0.0, SIDE, (count, 2))
    frame = np.column_stack([cosine, -sine, shift[:, 0], sine, cosine, shift[:, 1]])
    frame[:, 2] -= (frame[:, 0:2] * centres_px).sum(axis=1)
    frame[:, 5] -= (frame[:, 3:5] * centres_px).sum(axis=1)
    frame[:, [2, 5]] %= SIDE
    return RockLook(
        colour=_with_ground(ground, colour),
        weights=_with_ground(np.zeros(4), weights),
        relief_px=_with_ground(np.zeros(2), relief),
        frame=_with_ground(np.zeros(6), frame),
    )


def _with_ground(first: Floats, rest: Floats) -> Singles:
    return np.asarray(np.concatenate([first[None], rest]), dtype=np.float32)


def reflectance(
    grain: NDArray[np.int32],
    looks: RockLook,
    texture: Singles,
    ground_tint: Singles,
    level: Singles,
    *,
    dust: float,
) -> Singles:
    """Linear reflectance (rows, cols, 3); `level` is the vertical component of the normals."""
    weights = [np.ascontiguousarray(part)[grain] for part in looks.weights.T]
    log = weights[0] * texture[..., MOTTLE]
    log += weights[1] * texture[..., GRAIN]
    log += weights[2] * texture[..., PATTERN]
    log += np.where(grain == 0, ground_tint, np.float32(0.0))
    bright = np.exp(log)
    warm = weights[3] * (texture[..., PATTERN] + np.float32(0.6) * texture[..., MOTTLE])
    warm *= np.float32(0.5)
    colour = looks.colour[grain]
    colour *= bright[..., None]
    colour[..., 0] *= 1.0 + np.float32(0.5) * warm
    colour[..., 2] *= 1.0 - np.float32(0.7) * warm
    if dust > 0.0:
        lie = (level - np.float32(0.72)) * np.float32(1.0 / 0.28)
        lie = lie + np.float32(0.35) * texture[..., MOTTLE]
        cover = np.float32(dust) * lie.clip(0.0, 1.0) * (grain > 0)
        colour += cover[..., None] * (looks.colour[0] - colour)
    return np.asarray(colour)
