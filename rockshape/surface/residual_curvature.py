"""What stands out of a rock's ellipsoid: edges and relief, over the sphere the ellipsoid is."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid.half_axes import Ellipsoid
from rockshape.numerics.robust_scale import MEDIAN_TO_SIGMA
from rockshape.surface.basis import Knots
from rockshape.surface.height_map import (
    CELL,
    HeightMap,
    average_in_cells,
    covered_places,
)
from rockshape.surface.normal_equations import Net

NET = Net(u=Knots(32), w=Knots(32))
EDGE_SMOOTHING = 0.03  # radii: sharper edges look alike
EDGE_SPACING = 0.45  # of the points' distance: least smoothing, so that no single point is an edge
RELIEF_SMOOTHING = 0.08  # radii: the relief is what this smoothing takes away
MIN_POINTS = 144
EDGE = 0.2  # cosine from the view beyond which points are left out
FACING = 0.35  # cosine within which the relief is judged: nearer the limb range is thin
FADE = 0.12  # of cosine, over which bends come to count in full
MAX_NOISE = 2.2  # angularity by noise alone: most of the range from worn to sharp
STRONGEST = 3.0  # standard deviations from the mean bend that a bend may count
OUTLIER = 6.0  # robust standard deviations from the smooth surface
MAX_POINTS = 16_000  # in a fixed shuffle: some for each cell
MIN_OUTLIER = 0.05  # radii: an edge stands less than this from the smoothed surface


@dataclass(frozen=True)
class Relief:
    """Edges and relief over the ellipsoid, free of scale and unit."""

    edge_bend_cubed: float  # third central moment of -(r_xx + r_yy)/2 over the facing side
    noise_bend_cubed: float  # standard deviation of that by range noise
    rough: float  # robust standard deviation of the relief's height, over (abc)^(1/3)
    noise_rough: float  # the same of the draws of range noise
    facing: int  # number of points judged

    @property
    def resolves_edges(self) -> bool:
        """Whether range alone tells edges: noise alone has an angularity of at most 2.2."""
        return self.noise_bend_cubed <= MAX_NOISE**3


def measure_relief(
    ellipsoid: Ellipsoid,
    points_m: NDArray[np.float64],
    *,
    draws_m: NDArray[np.float64] | None = None,
    rank: NDArray[np.float64] | None = None,
) -> Relief | None:
    """Relief of points (n, 3) in the camera frame, the camera at the origin, over an ellipsoid.

    The map that takes the ellipsoid to the unit sphere takes the body's form and size out: each
    point becomes a direction and a height r = |y| - 1. The directions are laid out flat about the
    view by Lambert's equal-area projection, x and y in radii, and averaged in cells of 0.05, so
    that a rock is sampled alike from near and far. Cubic B-spline surfaces r(x, y) of the smoothing
    lengths 0.03, or 0.45 of the points' distance where that is more, and 0.08 are fitted. An
    ellipsoid bends by 0 everywhere. Edges bend outwards alone, relief as far in as out, and range
    noise as well: of the third central moment, which adds up over what is independent, edges have
    all. It is taken over the `covered_places`, with weights that rise from 0 to 1 at cosines from
    0.35 to 0.47 of the angle to the view, bends held to three standard deviations from their mean.
    The relief is what the longer smoothing takes away; the share of the cells that edges cross
    hardly moves the median of its absolute height.

    draws_m (n, k) are errors of z-depth like those of the points, from which the same surfaces
    tell what noise does. Of more than 16,000 points those of the lowest rank (n,) are taken. Points
    6 robust standard deviations off the first surface are left out.

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
    direction = sphere[keep] / radius[keep][:, None]
    # displaced along the ray by dz: y moves by S A p/z dz, and r by its part along y
    ray = points_m[keep] / points_m[keep][:, 2:] @ ellipsoid.axes.T / ellipsoid.half_axes_m
    slope = (direction * ray).sum(axis=1)
    errors = np.empty((len(keep), 0)) if draws_m is None else draws_m[keep] * slope[:, None]
    # height along the ellipsoid's normal for a unit of r, over the rock's size
    steep = np.sqrt(((direction / ellipsoid.half_axes_m) ** 2).sum(axis=1))
    normal = 1 / (steep * np.cbrt(ellipsoid.half_axes_m.prod()))
    place = np.column_stack([*_flat(direction, view), cosine[keep], normal])
    return _relief(place, np.column_stack([radius[keep] - 1, errors]))


def _relief(place: NDArray[np.float64], heights: NDArray[np.float64]) -> Relief | None:
    """Relief of points with places (n, 4): x, y, cosine and normal; and heights (n, 1 + draws)."""
    cells = average_in_cells(place, heights)
    surface = HeightMap.of(NET, cells.place[:, :2], cells.heights)
    smooth = None if surface is None else surface.fit(RELIEF_SMOOTHING)
    if smooth is None:
        return None
    misfit = np.abs(heights[:, 0] - smooth.heights[cells.cell, 0])
    sound = misfit <= max(OUTLIER * MEDIAN_TO_SIGMA * float(np.median(misfit)), MIN_OUTLIER)
    cells = average_in_cells(place[sound], heights[sound])
    spots = covered_places(place[sound, :2], within=cells.place[:, :2])
    cosine = 1 - (spots**2).sum(axis=1) / 2  # of the equal-area projection
    spots, cosine = spots[cosine > FACING], cosine[cosine > FACING]
    facing = cells.place[:, 2] > FACING
    count = int(cells.count[facing].sum())
    if count == 0 or len(spots) == 0:
        return None
    surface = HeightMap.of(NET, cells.place[:, :2], cells.heights, bends_at=spots)
    spacing = CELL * float(np.sqrt(len(spots) / count))
    if surface is None:
        return None
    smooth = surface.fit(RELIEF_SMOOTHING)
    fine = surface.fit(max(EDGE_SMOOTHING, EDGE_SPACING * spacing))
    if smooth is None or fine is None:
        return None
    weight = np.minimum((cosine - FACING) / FADE, 1.0)
    seen, draws = fine.bends[:, :1], fine.bends[:, 1:]
    cubed = float(_cubed(seen, weight)[0])
    moved = np.concatenate([_cubed(seen + sign * draws, weight) for sign in (1, -1)]) - cubed
    relief = ((cells.heights - smooth.heights) * cells.place[:, 3:])[facing]
    variance = (MEDIAN_TO_SIGMA * np.median(np.abs(relief), axis=0)) ** 2
    return Relief(
        edge_bend_cubed=cubed,
        noise_bend_cubed=float(np.sqrt(np.mean(moved**2))) if len(moved) else 0.0,
        rough=float(np.sqrt(variance[0])),
        noise_rough=float(np.sqrt(variance[1:].mean())) if len(moved) else 0.0,
        facing=count,
    )


def _cubed(bends: NDArray[np.float64], weight: NDArray[np.float64]) -> NDArray[np.float64]:
    """Third central moments (k,) of columns of bends (n, k), those outwards positive.

    Weighted by (n,); bends count up to three standard deviations from their mean.
    """
    share = weight / weight.sum()
    outwards = share @ bends - bends
    most = STRONGEST * np.sqrt(share @ outwards**2)
    held = np.clip(outwards, -most, most)
    return np.asarray(share @ (held - share @ held) ** 3)


def _flat(
    directions: NDArray[np.float64], view: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lambert's azimuthal equal-area projection of unit vectors (n, 3) about the view."""
    aside = np.eye(3)[np.argmin(np.abs(view))]
    across = np.cross(view, aside)
    across /= np.sqrt(across @ across)
    stretch = np.sqrt(2 / (1 + directions @ view))
    return stretch * (directions @ across), stretch * (directions @ np.cross(view, across))
