"""Stray points of a rock: small pieces of its range that lie apart from the rest of its surface."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid import Ellipsoid
from rockshape.ellipsoid.outliers import CUT, MAX_SHARE
from rockshape.numerics.robust_scale import median_scale
from rockshape.point_grid.connected_pieces import connected_pieces

if TYPE_CHECKING:
    from rockshape.ground import NoiseModel

STEP, STEP_PX = 0.02, 1.0  # of the rock's size or of a pixel's: step of height within a piece
SLIDE, SLIDE_PX = 0.06, 2.0  # and of depth
NOISE_STEP = 2.0  # further standard deviations of the range
MIN_PIECE = 0.02  # of the points
MAX_GAPS = 0.2  # of the rock's pixels


def stray_points(
    ellipsoid: Ellipsoid,
    grid_m: NDArray[np.float64],
    known: NDArray[np.bool_],
    noise: "NoiseModel | None",
    *,
    mask: NDArray[np.bool_],
) -> NDArray[np.bool_]:
    """Points (rows, cols) of grid_m (rows, cols, 3) that do not hang together with the surface.

    Of the pixels `known` (rows, cols), those more than six robust standard deviations off the
    ellipsoid, and those in `connected_pieces` of fewer than a fiftieth of the points. Within a
    piece neighbours may differ by 0.02 of the rock's size or by a pixel in their height over the
    ellipsoid, and by 0.06 or two pixels in depth, each and two standard deviations of the range.
    So a row or a column that is off is left out however near to the ellipsoid it lies. Where more
    than a tenth of the points would lie apart none does: the range is that rough. Nor does any
    where a fifth of the mask's pixels (rows, cols) have no point: gaps part pieces as well.
    """
    size_m = 2 * float(ellipsoid.half_axes_m[1])
    height = np.full(known.shape, np.nan)
    height[known] = ellipsoid.radial_distance_m(grid_m[known])
    near = np.abs(height) <= CUT * median_scale(height[known])
    slack = np.zeros(known.shape)
    if noise is not None:
        slack[known] = NOISE_STEP * noise.depth_sd_m(grid_m[known][:, 2])
    pixel_m = _pixel_m(grid_m, known)
    pieces = connected_pieces(
        (np.where(near, height, np.nan), max(STEP * size_m, STEP_PX * pixel_m) + slack),
        (grid_m[..., 2], max(SLIDE * size_m, SLIDE_PX * pixel_m) + slack),
    )
    small = np.bincount(pieces[near], minlength=pieces.size) < MIN_PIECE * known.sum()
    apart = near & small[pieces]
    gaps = mask.sum() - known.sum()
    if apart.sum() > MAX_SHARE * known.sum() or gaps > MAX_GAPS * mask.sum():
        apart[:] = False
    return np.asarray(known & (~near | apart))


def _pixel_m(grid_m: NDArray[np.float64], known: NDArray[np.bool_]) -> float:
    """Median distance across the view of neighbouring points; 0 where there are none."""
    across = np.abs(np.diff(grid_m[..., 0], axis=1))[known[:, 1:] & known[:, :-1]]
    return float(np.median(across)) if len(across) else 0.0
