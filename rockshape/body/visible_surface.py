"""Visible surface of a rock: its points without outliers, the range's noise reduced."""

from typing import TYPE_CHECKING

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid import Ellipsoid
from rockshape.ellipsoid.constrained_cost import ROUGH
from rockshape.ellipsoid.outliers import CUT, facing
from rockshape.numerics.robust_scale import median_scale

if TYPE_CHECKING:
    from rockshape.ground import NoiseModel

STEP, SLIDE = (
    0.02,
    0.06,
)  # of the rock's size: by how much neighbours' heights and depths may differ
NOISE_STEP = 2.0  # and in standard deviations of the range
MIN_NEIGHBOURS = 2  # of eight, that a point must agree with
PATCH = np.ones((3, 3), dtype=np.uint8)  # least part that is seen beyond the ellipsoid's horizon
TINY = 1e-12


def visible_surface(
    ellipsoid: Ellipsoid,
    grid_m: NDArray[np.float64],
    known: NDArray[np.bool_],
    noise: "NoiseModel | None",
) -> NDArray[np.float64]:
    """Points (n, 3) of the pixels `known` (rows, cols) of grid_m (rows, cols, 3), noise reduced.

    Heights are radial distances from the ellipsoid. Left out are points more than six robust
    standard deviations off it; those that agree with fewer than two of their eight neighbours, in
    height to within 0.02 and in depth to within 0.06 of the rock's size, each and two standard
    deviations of the range; and those beyond the ellipsoid's horizon that are no part of a patch of
    3 x 3. A larger patch there is the rock's own: a rock is no ellipsoid.

    Without noise the points are the measured ones. Otherwise a height is the mean over a square two
    pixels wider than the noise's window, times s²/(s² + v): s is how far rocks depart from
    ellipsoids, 0.08 of their size, and v the variance that noise leaves in the mean (a Wiener
    filter).
    """
    size_m = 2 * float(ellipsoid.half_axes_m[1])
    points_m = grid_m[known]
    height = np.full(known.shape, np.nan)
    height[known] = ellipsoid.radial_distance_m(points_m)
    sd_m = np.zeros(len(points_m)) if noise is None else noise.depth_sd_m(points_m[:, 2])
    slack = np.zeros(known.shape)
    slack[known] = NOISE_STEP * sd_m
    beyond = np.ones(known.shape, dtype=np.bool_)  # where nothing is known, as well
    beyond[known] = facing(ellipsoid, points_m) < 0
    wide = np.pad(beyond, 2, constant_values=True).view(np.uint8)
    patches = cv2.morphologyEx(wide, cv2.MORPH_OPEN, PATCH)[2:-2, 2:-2] > 0
    steps = (height, STEP * size_m + slack), (grid_m[..., 2], SLIDE * size_m + slack)
    sound = np.abs(height) <= CUT * median_scale(height[known])
    sound &= (_agreeing(*steps) >= MIN_NEIGHBOURS) & (patches | ~beyond)
    points_m = grid_m[sound]
    if noise is None or noise.inverse_depth_sd_per_m == 0:
        return np.asarray(points_m)
    side = noise.window_px + 2
    variance = noise.depth_sd_m(points_m[:, 2]) ** 2 * noise.mean_variance(side)
    own = (ROUGH * size_m) ** 2
    mean = _mean(np.where(sound, height, 0), sound, side) * own / (own + variance)
    away = points_m - ellipsoid.centre_m
    length = np.maximum(np.linalg.norm(away, axis=1), TINY)
    level = np.maximum(np.linalg.norm(ellipsoid.to_sphere(points_m), axis=1), TINY)
    return np.asarray(ellipsoid.centre_m + away * (1 / level + mean / length)[:, None])


def _agreeing(*steps: tuple[NDArray[np.float64], NDArray[np.float64]]) -> NDArray[np.int8]:
    """Number (rows, cols) of a pixel's eight neighbours that differ by no more than its steps.

    steps are images (rows, cols), NaN where unknown, each with the step that is allowed.
    """
    rows, cols = steps[0][0].shape
    wide = [(np.pad(image, 1, constant_values=np.nan), image, step) for image, step in steps]
    count = np.zeros((rows, cols), dtype=np.int8)
    for row in range(3):
        for col in range(3):
            if (row, col) != (1, 1):
                window = np.s_[row : row + rows, col : col + cols]
                count += np.logical_and.reduce(
                    [np.abs(around[window] - image) <= step for around, image, step in wide]
                )
    return count


def _mean(values: NDArray[np.float64], sound: NDArray[np.bool_], side: int) -> NDArray[np.float64]:
    """Mean (n,) of the values of sound pixels in a square about each of them."""
    total, count = (
        cv2.boxFilter(part, -1, (side, side), normalize=False, borderType=cv2.BORDER_CONSTANT)
        for part in (values, sound.astype(np.float64))
    )
    return np.asarray(total[sound] / count[sound])
