"""Visible surface of a rock: its points without outliers, the range's noise reduced."""

from typing import TYPE_CHECKING

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid import Ellipsoid
from rockshape.ellipsoid.constrained_cost import ROUGH
from rockshape.ellipsoid.outliers import facing

if TYPE_CHECKING:
    from rockshape.ground import NoiseModel

PATCH = np.ones((3, 3), dtype=np.uint8)  # least part that is seen beyond the ellipsoid's horizon
TINY = 1e-12


def visible_surface(
    ellipsoid: Ellipsoid,
    grid_m: NDArray[np.float64],
    attached: NDArray[np.bool_],
    noise: "NoiseModel | None",
) -> NDArray[np.float64]:
    """Points (n, 3) of the pixels `attached` (rows, cols) of grid_m (rows, cols, 3), less noise.

    Left out are points beyond the ellipsoid's horizon that are no part of a patch of 3 x 3. A
    larger patch there is the rock's own: a rock is no ellipsoid.

    Without noise the points are the measured ones. Otherwise a height, the radial distance from
    the ellipsoid, is the mean over a square two pixels wider than the noise's window, times
    s²/(s² + v): s is how far rocks depart from ellipsoids, 0.08 of their size, and v the variance
    that noise leaves in the mean (a Wiener filter).
    """
    beyond = np.ones(attached.shape, dtype=np.bool_)  # where nothing is known, as well
    beyond[attached] = facing(ellipsoid, grid_m[attached]) < 0
    wide = np.pad(beyond, 2, constant_values=True).view(np.uint8)
    patches = cv2.morphologyEx(wide, cv2.MORPH_OPEN, PATCH)[2:-2, 2:-2] > 0
    sound = attached & (patches | ~beyond)
    points_m = grid_m[sound]
    if noise is None or noise.inverse_depth_sd_per_m == 0:
        return np.asarray(points_m)
    size_m = 2 * float(ellipsoid.half_axes_m[1])
    height = np.zeros(attached.shape)
    height[sound] = ellipsoid.radial_distance_m(points_m)
    side = noise.window_px + 2
    variance = noise.depth_sd_m(points_m[:, 2]) ** 2 * noise.mean_variance(side)
    own = (ROUGH * size_m) ** 2
    mean = _mean(height, sound, side) * own / (own + variance)
    away = points_m - ellipsoid.centre_m
    length = np.maximum(np.linalg.norm(away, axis=1), TINY)
    level = np.maximum(np.linalg.norm(ellipsoid.to_sphere(points_m), axis=1), TINY)
    return np.asarray(ellipsoid.centre_m + away * (1 / level + mean / length)[:, None])


def _mean(values: NDArray[np.float64], sound: NDArray[np.bool_], side: int) -> NDArray[np.float64]:
    """Mean (n,) of the values of sound pixels in a square about each of them."""
    total, count = (
        cv2.boxFilter(part, -1, (side, side), normalize=False, borderType=cv2.BORDER_CONSTANT)
        for part in (values, sound.astype(np.float64))
    )
    return np.asarray(total[sound] / count[sound])
