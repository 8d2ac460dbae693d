"""A smooth surface over the ground plane, for ground that undulates."""

from dataclasses import dataclass

import numpy as np
import scipy.ndimage as ndi
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import spsolve

from rockshape.ground.noise import Noise

Floats = NDArray[np.float64]

CELL = 0.02  # side of a cell over its distance from the camera's foot
MOST_CELLS = 20_000
STIFF = 0.2  # weight of the surface's bending against a cell's misfit
ROUNDS = 5
UNEVEN = 1.0  # scatters of a cell's points that cells may differ by on a plane
WIDE = 5.0  # scatters above the surface at which a cell starts to lose its weight, at first
NARROW = 2.0  # and in the end
LEAST = 0.08  # of the undulation's own rise stays within the weight, or crests are taken for rocks
FEWEST_IN_CELL = 4
FEWEST_CELLS = 40
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
    nodes_m: Floats  # (azimuths, distances)
    misfit_m: float  # scatter of the cells about it, from their lowest

    def height_m(self, points_m: Floats) -> Floats:
        """Height (...) of the surface above the plane under points (..., 3), 0 under none."""
        place = (_polar(points_m, self.axes) - self.origin) / CELL
        known = np.isfinite(place).all(axis=-1)
        height = np.zeros(known.shape)
        height[known] = ndi.map_coordinates(
            self.nodes_m, place[known].T, order=1, mode="nearest", prefilter=False
        )
        return height


def _polar(points_m: Floats, axes: Floats) -> Floats:
    """Azimuth from straight ahead and log distance from the camera's foot, (..., 2)."""
    across, ahead = points_m @ axes[0], points_m @ axes[1]
    distance = np.maximum(np.hypot(across, ahead), 1e-3)
    return np.stack([np.arctan2(across, ahead), np.log(distance)], axis=-1)


def fit_swell(points_m: Floats, *, normal: Floats, height_m: Floats, noise: Noise) -> Swell | None:
    """A smooth surface through the points (n, 3) of the ground, or None where a plane will do.

    Points are gathered in the cells of a grid over the plane; a cell's height is their median.
    The plane is enough where the lower cells differ, from their 10 % to their 40 % quantile, no
    more than the points within one cell scatter. Else the surface s minimises sum w (h - s)^2 +
    0.2 sum (bending of s)^2 over the cells. The weight w of cells that stand above the surface
    falls from 1 to 0, for rocks only ever add; its width narrows in five rounds from 5 to 2 times
    the cells' own rise from quantile to quantile.
    """
    ahead = np.array([0.0, 0.0, 1.0]) - normal[2] * normal
    length = float(np.linalg.norm(ahead))
    if length < 1e-6:  # straight down: any direction is ahead
        return None
    axes = np.stack([np.cross(normal, ahead / length), ahead / length])
    polar = _polar(points_m, axes)
    low, high = np.quantile(polar, (0.005, 0.98), axis=0)
    shape = tuple(int(side) for side in np.ceil((high - low) / CELL) + 1)
    if np.prod(shape) > MOST_CELLS:
        return None
    place = np.rint((polar - low) / CELL).astype(int)
    inside = ((place >= 0) & (place < shape)).all(axis=1)
    number = np.ravel_multi_index(tuple(place[inside].T), shape)
    cells = _gather(number, height_m[inside])
    if len(cells.number) < FEWEST_CELLS:
        return None
    far = np.bincount(number, points_m[inside, 2]) / np.maximum(np.bincount(number), 1)
    finest = noise.pixel_rad * far[cells.number]
    scatter = np.maximum(cells.scatter_m, finest)
    if _rise(cells.middle_m / scatter) <= UNEVEN:
        return None
    nodes_m = _bend(cells, shape)
    misfit = cells.middle_m - nodes_m.ravel()[cells.number]
    misfit_m = max(0.0, -float(np.quantile(misfit, TAIL))) / NORMAL_TAIL
    return Swell(axes=axes, origin=low, nodes_m=nodes_m, misfit_m=misfit_m)


def _rise(value: Floats) -> float:
    """From the 10 % to the 40 % quantile, which rocks on less than half of the ground leave be."""
    return float(np.subtract(*np.quantile(value, (0.4, 0.1))))


@dataclass(frozen=True, eq=False)
class _Cells:
    """The cells that hold points enough."""

    number: NDArray[np.intp]  # (m,), in the grid
    middle_m: Floats  # median height
    scatter_m: Floats  # of the lower half


def _gather(number: NDArray[np.intp], height_m: Floats) -> _Cells:
    order = np.lexsort((height_m, number))
    sorted_m = height_m[order]
    cells, first, count = np.unique(number[order], return_index=True, return_counts=True)
    enough = count >= FEWEST_IN_CELL
    cells, first, count = cells[enough], first[enough], count[enough]
    middle = sorted_m[first + count // 2]
    lower = sorted_m[first + np.floor(NORMAL_BELOW * count).astype(int)]
    return _Cells(cells, middle, middle - lower)


def _bend(cells: _Cells, shape: tuple[int, ...]) -> Floats:
    """Nodes of the surface through the cells, by reweighted least squares."""
    stiff = STIFF * _bending(shape)
    height = np.zeros(shape[0] * shape[1])
    seen = np.zeros(len(height))
    height[cells.number], seen[cells.number] = cells.middle_m, 1.0
    surface = np.zeros(len(height))
    scale = least = _rise(cells.middle_m)
    least *= LEAST
    for width in np.geomspace(WIDE, NARROW, ROUNDS):
        reach = max(width * scale, 1e-9)
        rise = np.maximum(height - surface, 0) / (2 * reach)
        weight = seen * np.maximum(1 - rise**2, 0) ** 2
        # cells without weight are held by the bending alone, which a plane's freedom leaves open
        surface = spsolve((sp.diags(weight + 1e-6) + stiff).tocsc(), weight * height)
        misfit = (height - surface)[cells.number]
        scale = max(_rise(misfit), least)
    return np.asarray(surface.reshape(shape))


def _bending(shape: tuple[int, ...]) -> sp.csc_matrix:
    """Sum of squared second differences along both axes and across, as a quadratic form."""

    def differences(count: int, order: int) -> sp.csr_matrix:
        steps = sp.identity(count, format="csr")
        for _ in range(order):
            steps = steps[1:] - steps[:-1]
        return steps

    rows, cols = shape
    down = sp.kron(differences(rows, 2), sp.identity(cols))
    across = sp.kron(sp.identity(rows), differences(cols, 2))
    twist = sp.kron(differences(rows, 1), differences(cols, 1))
    return (down.T @ down + across.T @ across + 2 * (twist.T @ twist)).tocsc()
