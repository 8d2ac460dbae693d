"""A smooth surface over the ground plane, for ground that undulates.

Sand lies at less than its angle of repose; rocks have steep flanks. So what rises no steeper than
sand can is ground, be it a crest as high as a low rock, and a smooth surface is laid through it.
"""

from dataclasses import dataclass

import cv2
import numpy as np
import scipy.ndimage as ndi

from rockshape.ground.noise_model import PIXEL_SHARE, NoiseModel
from rockshape.ground.plane import Plane
from rockshape.ground.slope_filter import gentle_below
from rockshape.ground.thin_plate import bend
from rockshape.numerics.arrays import Floats, Mask, Singles

COARSE_CELL = 0.03  # side of a cell over its distance from the camera's foot: to tell undulation
FINE_CELL = 0.01  # and to follow it
MAX_CELLS = 20_000
UNEVEN = 0.85  # scatters that the lower cells may differ by on a plane
STEEPEST = 0.5  # slope of ground, 27 degrees; dry sand lies at up to 32
MAX_SCATTER = 2.0  # of a cell's points over that usual at its distance: on rocks they scatter more
NEAR_CELLS = 1.0  # standard deviation of the average that a cell beside a rock is held to,
NEAR_RISE = 0.5  # and the share of the steepest rise that it may stand above it
STIFF = 0.2  # weight of the surface's bending against a cell's misfit
TAUT = 0.002  # and of its rise
MIN_IN_CELL = 3
MEDIAN_VARIANCE = 1.57  # of n normal values' median over that of their mean
MIN_CELLS = 40
TAIL, NORMAL_TAIL = 0.03, 1.881  # a low quantile, and where a normal distribution has it
NORMAL_BELOW = 0.1587  # share of a normal distribution more than its deviation below its middle


@dataclass(frozen=True, eq=False)
class Swell:
    """Heights above a plane on a grid of azimuth and the logarithm of distance.

    Both are seen from the foot of the camera, so that a cell is square and grows with distance as
    what the camera can tell does. Linear between nodes, level outside the grid.
    """

    axes: Floats  # (2, 3), unit vectors in the plane, the second straight ahead
    origin: Floats  # (2,), of the grid: azimuth in radians and log distance in metres
    cell: float  # side of a cell in both
    nodes_m: Singles  # (azimuths, distances)
    misfit_m: float  # scatter about it of the cells that are ground, without range noise's share

    def height_m(self, points_m: Floats) -> Singles:
        """Height (...) of the surface above the plane under points (..., 3), 0 under none."""
        place = (_polar(points_m, self.axes) - self.origin.astype(np.float32)) / self.cell
        known = np.isfinite(place).all(axis=-1)
        place = np.moveaxis(np.where(known[..., None], place, 0), -1, 0)
        # cv2.remap rounds places to 1/32 of a cell before OpenCV 5
        height = ndi.map_coordinates(
            self.nodes_m, place, order=1, mode="nearest", output=np.float32
        )
        return np.where(known, height, np.float32(0))


def undulates(points_m: Floats, *, plane: Plane, noise: NoiseModel, pixels_each: int = 1) -> bool:
    """Whether the ground under points (n, 3) is no plane.

    Points are gathered in the cells of a grid over the plane. It is one where the lower cells
    differ, from their 10 % to their 40 % quantile, which rocks on less than half of the ground
    leave be, no more than the points within one cell scatter, or the range's noise there: a cell
    may lie within one matching window, whose points share an error.
    """
    cells = _gather(points_m, plane=plane, noise=noise, pixels_each=pixels_each, cell=COARSE_CELL)
    if cells is None:
        return False
    value = cells.middle_m[cells.seen] / np.maximum(cells.scatter_m, cells.noise_m)[cells.seen]
    return float(np.subtract(*np.quantile(value, (0.4, 0.1)))) > UNEVEN


def fit_swell(
    points_m: Floats, *, plane: Plane, noise: NoiseModel, pixels_each: int = 1
) -> Swell | None:
    """A smooth surface through the points (n, 3) of ground that undulates.

    A cell of the grid has the median height h of its points. Of the cells those are ground that lie
    on the highest surface below all of them which is nowhere steeper than 27 degrees (see
    `envelope`), to within their own points' scatter, which counts for no more than twice what is
    usual at their distance. Cells beside one that is not may hold points of both: they are ground
    where they stand less than half of the steepest rise over the average of the ground near them.
    The surface s minimises sum (h - s)^2 over the ground, + 0.2 sum (bending)^2 + 0.002 sum
    (rise)^2 over all cells (see `bend`), so that it passes calmly below rocks. None where too few
    cells are seen.
    """
    cells = _gather(points_m, plane=plane, noise=noise, pixels_each=pixels_each, cell=FINE_CELL)
    if cells is None:
        return None
    ground = _ground_cells(cells)
    nodes_m = bend(cells.middle_m, ground.astype(np.float32), stiff=STIFF, taut=TAUT)
    low, high = np.quantile((cells.middle_m - nodes_m)[ground], (TAIL, 1 - TAIL))
    scatter_m = max(-float(low), float(high), 0.0) / NORMAL_TAIL
    noise_m = float(np.sqrt(np.mean(cells.noise_m[ground] ** 2))) if ground.any() else 0.0
    misfit_m = float(np.sqrt(max(scatter_m**2 - noise_m**2, 0.0)))
    return Swell(cells.axes, cells.origin, cells.side, nodes_m, misfit_m)


def _polar(points_m: Floats, axes: Floats) -> Singles:
    """Azimuth from straight ahead and log distance from the camera's foot, (..., 2)."""
    flat = (points_m @ axes.T).astype(np.float32)
    across, ahead = flat[..., 0], flat[..., 1]
    distance = np.maximum(np.hypot(across, ahead), np.float32(1e-3))
    return np.stack([np.arctan2(across, ahead), np.log(distance)], axis=-1)


@dataclass(frozen=True, eq=False)
class _Cells:
    """Points gathered over a grid; (azimuths, distances) unless said."""

    axes: Floats  # (2, 3)
    origin: Floats  # (2,)
    side: float
    seen: Mask  # holds points enough
    middle_m: Singles  # median height, 0 where not seen
    scatter_m: Singles  # of the lower half, at least a quarter of a pixel's size
    noise_m: Singles  # standard deviation of the median by range noise


def _gather(
    points_m: Floats, *, plane: Plane, noise: NoiseModel, pixels_each: int, cell: float
) -> _Cells | None:
    normal, height_m = plane.normal, plane.height_m(points_m)
    ahead = np.array([0.0, 0.0, 1.0]) - normal[2] * normal
    length = float(np.linalg.norm(ahead))
    if length < 1e-6:  # straight down: any direction is ahead
        return None
    axes = np.stack([np.cross(normal, ahead / length), ahead / length])
    polar = _polar(points_m, axes)
    low, high = np.quantile(polar, (0.002, 0.99), axis=0).astype(np.float64)
    side = max(cell, float(np.sqrt(np.prod(high - low) / MAX_CELLS)))
    shape = tuple(int(count) for count in np.ceil((high - low) / side) + 1)
    place = np.rint((polar - low) / side).astype(np.intp)
    inside = ((place >= 0) & (place < shape)).all(axis=1)
    number = place[inside, 0] * shape[1] + place[inside, 1]
    height = height_m[inside]
    if len(height) < MIN_CELLS * MIN_IN_CELL:
        return None
    # one sort orders cells and, within each, heights: a cell's number and its heights' share of 1
    lowest, span = height.min(), max(1.001 * float(np.ptp(height)), 1e-9)
    ordered = np.sort(number + (height - lowest) / span)
    count = np.bincount(number, minlength=shape[0] * shape[1])
    first = np.cumsum(count) - count
    own = np.flatnonzero(count >= MIN_IN_CELL)
    if len(own) < MIN_CELLS:
        return None
    middle, lower = (
        (ordered[first[own] + np.floor(share * count[own]).astype(np.intp)] - own) * span + lowest
        for share in (0.5, NORMAL_BELOW)
    )
    far = np.bincount(number, points_m[inside, 2], minlength=len(count))[own] / count[own]
    least = PIXEL_SHARE * noise.pixel_rad * far
    seen = np.zeros(len(count), dtype=bool)
    middle_m, scatter_m, noise_m = np.zeros((3, len(count)), dtype=np.float32)
    seen[own], middle_m[own], scatter_m[own] = True, middle, np.maximum(middle - lower, least)
    windows = count[own] * pixels_each / noise.window_px**2
    share = np.sqrt(np.minimum(MEDIAN_VARIANCE / windows, 1))
    noise_m[own] = share * noise.inverse_depth_sd_per_m * far * -plane.offset_m
    return _Cells(
        axes,
        low,
        side,
        seen=seen.reshape(shape),
        middle_m=middle_m.reshape(shape),
        scatter_m=scatter_m.reshape(shape),
        noise_m=noise_m.reshape(shape),
    )


def _ground_cells(cells: _Cells) -> Mask:
    """Which cells are ground, (azimuths, distances)."""
    distance_m = np.exp(cells.origin[1] + cells.side * np.arange(cells.seen.shape[1]))
    rise_m = STEEPEST * cells.side * distance_m
    gentle_m = gentle_below(np.where(cells.seen, cells.middle_m, np.inf), rise_m)
    own_m = np.ma.masked_array(cells.scatter_m, ~cells.seen)
    usual_m = np.ma.median(own_m, axis=0).filled(0)  # type: ignore[no-untyped-call]
    slack_m = np.minimum(cells.scatter_m, MAX_SCATTER * usual_m)
    steep = cells.seen & (cells.middle_m - gentle_m > slack_m)
    beside = cv2.dilate(steep.astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
    sure = (cells.seen & ~beside).astype(np.float32)
    total, weight = (
        ndi.gaussian_filter(part, NEAR_CELLS) for part in (sure * cells.middle_m, sure)
    )
    average_m = total / np.maximum(weight, np.float32(1e-6))
    calm = cells.middle_m - average_m < NEAR_RISE * rise_m
    return np.asarray(cells.seen & ~steep & (~beside | calm))
