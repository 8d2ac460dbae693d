"""What stands out of a rock's ellipsoid, as a surface over the sphere the ellipsoid is."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid.half_axes import Ellipsoid
from rockshape.numerics.robust_scale import MEDIAN_TO_SIGMA
from rockshape.surface.basis import Knots, evaluate
from rockshape.surface.normal_equations import Net, bending, factorise, normal_equations, rows

NET = Net(u=Knots(24), w=Knots(24))
SMOOTHING = 0.08  # radii: waves shorter than half a radius are flattened
MIN_POINTS = 144  # a quarter of the net's vertices
EDGE = 0.1  # cosine from the view beyond which points are left out
FACING = 0.35  # cosine within which the relief is judged: nearer the limb range is thin
OUTLIER = 6.0  # robust standard deviations from the first surface
MAX_POINTS = 4000  # in a fixed shuffle: the smoothing needs no more
MIN_OUTLIER = 0.05  # radii: an edge stands less than this from the smoothed surface


@dataclass(frozen=True)
class ResidualCurvature:
    """Second derivatives of the height over the ellipsoid, free of scale and unit."""

    bend: float  # RMS over the facing points of (r_xx + r_yy)/2
    noise_bend: float  # the same of the draws of range noise
    facing: int  # number of points judged


def measure_relief(
    ellipsoid: Ellipsoid,
    points_m: NDArray[np.float64],
    *,
    draws_m: NDArray[np.float64] | None = None,
    rank: NDArray[np.float64] | None = None,
) -> ResidualCurvature | None:
    """Relief of points (n, 3) in the camera frame, the camera at the origin, over an ellipsoid.

    The map that takes the ellipsoid to the unit sphere takes the body's form and size out: each
    point becomes a direction and a height r = |y| - 1. The directions are laid out flat about the
    view by Lambert's equal-area projection, x and y in radii, and a cubic B-spline surface r(x, y)
    with the smoothing length 0.08 is fitted. An ellipsoid has bend 0 everywhere; an edge of radius
    ρ across which the surface turns by θ adds about θ/ρ over a strip θρ wide, so that the square's
    mean tells sharp edges from round ones where the mean of the absolute value cannot.

    draws_m (n, k) are errors of z-depth like those of the points, from which the same surface
    gives `noise_bend`. Of more than 4000 points those of the lowest rank (n,) are taken. Points 6
    robust standard deviations off the first surface are left out.

    None where the facing points leave the surface undetermined.
    """
    sphere = ellipsoid.to_sphere(points_m)
    radius = np.sqrt((sphere**2).sum(axis=1))
    view = ellipsoid.to_sphere(np.zeros(3))
    view /= np.sqrt(view @ view)
    cosine = sphere @ view / np.maximum(radius, 1e-12)
    keep = np.flatnonzero(cosine > EDGE)
    if len(keep) < MIN_POINTS:
        return None
    if len(keep) > MAX_POINTS:
        shuffle = np.random.default_rng(0)
        order = shuffle.permutation(len(keep)) if rank is None else np.argsort(rank[keep])
        keep = keep[order[:MAX_POINTS]]
    # displaced along the ray by dz: y moves by S A p/z dz, and r by its part along y
    ray = points_m[keep] / points_m[keep][:, 2:] @ ellipsoid.axes.T / ellipsoid.half_axes_m
    slope = (sphere[keep] * ray).sum(axis=1) / radius[keep]
    errors = np.empty((len(keep), 0)) if draws_m is None else draws_m[keep] * slope[:, None]
    x, y = _flat(sphere[keep] / radius[keep][:, None], view)
    heights = np.column_stack([radius[keep] - 1, errors])
    fit = _bends(x, y, heights)
    if fit is None:
        return None
    misfit = np.abs(fit[1])
    sound = misfit <= max(OUTLIER * MEDIAN_TO_SIGMA * float(np.median(misfit)), MIN_OUTLIER)
    if not sound.all():
        fit = _bends(x[sound], y[sound], heights[sound])
    facing = cosine[keep][sound] > FACING
    if fit is None or not facing.any():
        return None
    square = (fit[0][facing] ** 2).mean(axis=0)
    return ResidualCurvature(
        bend=float(np.sqrt(square[0])),
        noise_bend=float(np.sqrt(square[1:].mean())) if len(square) > 1 else 0.0,
        facing=int(facing.sum()),
    )


def _flat(
    directions: NDArray[np.float64], view: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lambert's azimuthal equal-area projection of unit vectors (n, 3) about the view."""
    aside = np.eye(3)[np.argmin(np.abs(view))]
    across = np.cross(view, aside)
    across /= np.sqrt(across @ across)
    stretch = np.sqrt(2 / (1 + directions @ view))
    return stretch * (directions @ across), stretch * (directions @ np.cross(view, across))


def _bends(
    x: NDArray[np.float64], y: NDArray[np.float64], heights: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """(r_xx + r_yy)/2 (n, k) of surfaces through columns of heights, and the first's misfit."""
    low, size = (x.min(), y.min()), (float(np.ptp(x)), float(np.ptp(y)))
    if min(size) <= 0:
        return None
    u, w = (x - low[0]) / size[0], (y - low[1]) / size[1]
    along_u, along_w = evaluate(NET.u, u), evaluate(NET.w, w)
    data = rows(NET, along_u, along_w)
    bands, side = normal_equations(data, heights)
    factor = factorise(bands + len(x) * SMOOTHING**4 * bending(NET, *size))
    if factor is None:
        return None
    vertices = factor.solve(side)
    bend_u = data.like(evaluate(NET.u, u, derivative=2), along_w).products / size[0] ** 2
    bend_w = data.like(along_u, evaluate(NET.w, w, derivative=2)).products / size[1] ** 2
    bend = replace(data, products=(bend_u + bend_w) / 2)
    return bend.at(vertices), heights[:, 0] - data.at(vertices[:, 0])
