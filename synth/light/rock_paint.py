"""Paint of rocks: veins and layers, averaged over the pixel."""

import numpy as np

from synth.arrays import Floats, Singles
from synth.light.body import Paint
from synth.scene.finish import Finish

_VEIN_RGB = np.array([0.72, 0.70, 0.66], dtype=np.float32)  # reflectance of what fills a vein
_BEND_M, _BEND_PER_M = 0.004, 60.0  # a vein's plane sways by this much, with so many radians
_LAYERS = 0.22  # RMS of the layers' reflectance over the mean
_DARKEST = 0.3


def rock_paint(finish: Finish, reflectance: Floats) -> Paint | None:
    """Paint of a rock whose own reflectance is (3,) in R, G, B; None without veins and layers."""
    if not len(finish.veins) and not len(finish.layers):
        return None

    def paint(points_m: Singles, side_m: Singles) -> Singles:
        layered = _layered(finish.layers, points_m, side_m)[:, None]
        cover = _cover(finish.veins, points_m, side_m)[:, None]
        vein = _VEIN_RGB / reflectance.astype(np.float32)
        return np.asarray((1.0 - cover) * layered + cover * vein, dtype=np.float32)

    return paint


def _layered(layers: Floats, points_m: Singles, side_m: Singles) -> Singles:
    """Factor (n,) of the layers: waves of equal power, each averaged over the footprint.

    A sinusoid's mean over a length w is sinc(w k/2π) of it.
    """
    total = np.zeros(len(points_m), dtype=np.float32)
    if not len(layers):
        return total + np.float32(1.0)
    for *wave, phase in layers.tolist():
        turns = np.float32(np.linalg.norm(wave) / (2.0 * np.pi)) * side_m
        total += np.sinc(turns) * np.sin(points_m @ np.array(wave, dtype=np.float32) + phase)
    rms = np.float32(_LAYERS * np.sqrt(2.0 / len(layers)))
    return np.asarray(np.maximum(np.float32(1.0) + rms * total, np.float32(_DARKEST)))


def _cover(veins: Floats, points_m: Singles, side_m: Singles) -> Singles:
    """Share (n,) of each footprint that veins cover: their overlap along the plane's normal."""
    cover = np.zeros(len(points_m), dtype=np.float32)
    sway = np.float32(_BEND_M) * np.sin(np.float32(_BEND_PER_M) * points_m.sum(axis=1))
    for *normal, place_m, width_m in veins.tolist():
        off_m = points_m @ np.array(normal, dtype=np.float32) - np.float32(place_m) + sway
        low = np.maximum(off_m - side_m / 2.0, np.float32(-width_m / 2.0))
        high = np.minimum(off_m + side_m / 2.0, np.float32(width_m / 2.0))
        share = np.maximum(high - low, 0.0) / np.maximum(side_m, np.float32(1e-9))
        cover = np.maximum(cover, np.minimum(share, 1.0))
    return cover
