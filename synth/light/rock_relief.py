"""Fine relief of rocks: grain and pits too small for their triangles, in the light alone."""

from functools import cache

import numpy as np

from synth.arrays import Floats, Singles
from synth.light.body import Relief
from synth.light.texture import plane_weights
from synth.noise import MipMap, fractal, slopes, stones

_SIDE, _SEED = 1024, 19970704
_TEXEL_M = 0.001
_SLOPE = 3.2  # power of the heights falls as frequency^−slope
_PITS = ((8, 0.35), (16, 0.3), (32, 0.2))  # texels between pits, share that is there
_PIT_DEPTH = 0.5  # over that of a stone as high as it is wide
_LEAST_WEIGHT = 0.05


def rock_relief(model_to_world: Floats, position_m: Floats, slope: float) -> Relief | None:
    """Relief of a rock with a frame in the world, of an RMS slope; None where that is 0.

    Three planes' patterns are mixed by the normal's components to the fourth power, as the
    albedo's texture is.
    """
    if slope == 0.0:
        return None
    turn, origin_m = model_to_world.astype(np.float32), position_m.astype(np.float32)

    def relief(points_m: Singles, normals: Singles, footprint_m: Singles) -> Singles:
        own_m = np.asarray((points_m - origin_m) @ turn, dtype=np.float32)
        own = np.asarray(normals @ turn, dtype=np.float32)
        tilts = np.float32(slope) * _tilts(own_m, own, footprint_m)
        tilts -= np.einsum("ij,ij->i", tilts, own)[:, None] * own
        rough = (own - tilts) @ turn.T
        return np.asarray(rough / np.linalg.norm(rough, axis=1, keepdims=True))

    return relief


def _tilts(points_m: Singles, normals: Singles, footprint_m: Singles) -> Singles:
    """Gradients (n, 3) of the relief at points of a rock's frame."""
    weights = plane_weights(normals)
    scale = np.float32(1.0 / _TEXEL_M)
    tilts = np.zeros_like(points_m)
    for axis in range(3):
        shown = np.flatnonzero(weights[:, axis] > _LEAST_WEIGHT)
        one, two = (axis + 1) % 3, (axis + 2) % 3
        found = _slopes().at(
            (points_m[shown, one] + np.float32(0.31 * axis)) * scale,
            points_m[shown, two] * scale,
            footprint_m[shown] * scale,
        )
        tilts[shown, one] += weights[shown, axis] * found[:, 0]
        tilts[shown, two] += weights[shown, axis] * found[:, 1]
    return tilts


@cache
def _slopes() -> MipMap:
    """Slopes of grain and pits along columns and rows, of unit RMS."""
    rng = np.random.default_rng(_SEED)
    height = 4.0 * fractal(_SIDE, _SLOPE, rng, longest_px=_SIDE / 8)
    for spacing, share in _PITS:
        depth, _ = stones(_SIDE, spacing, share, rng)
        height -= _PIT_DEPTH * depth
    tilts = slopes(height)
    rms = np.sqrt((tilts**2).sum(axis=-1).mean())
    return MipMap(np.asarray(tilts / rms, dtype=np.float32))
