"""Heights over a plane: averages in even cells, and B-spline surfaces of several smoothings."""

from dataclasses import dataclass, replace
from typing import Self

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.surface.basis import evaluate
from rockshape.surface.normal_equations import (
    Net,
    Rows,
    bending,
    factorise,
    normal_equations,
    rows,
)

CELL = 0.05  # side, in the unit of the places
DISK = np.asarray(cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (5, 5)))


@dataclass(frozen=True, eq=False)
class Cells:
    """Means of points over the square cells that hold any."""

    place: NDArray[np.float64]  # (m, 2 + further), mean places, and what is known of each
    heights: NDArray[np.float64]  # (m, k), mean heights
    count: NDArray[np.intp]  # (m,), number of points
    cell: NDArray[np.intp]  # (n,), cell of each point


def average_in_cells(place: NDArray[np.float64], heights: NDArray[np.float64]) -> Cells:
    """Cells of points with places (n, 2 + further), x and y first, and heights (n, k)."""
    column, row = np.floor((place[:, :2] - place[:, :2].min(axis=0)) / CELL).astype(np.intp).T
    _, cell, count = np.unique(
        column * (row.max() + 1) + row, return_inverse=True, return_counts=True
    )

    def means(values: NDArray[np.float64]) -> NDArray[np.float64]:
        sums = [np.bincount(cell, column, len(count)) for column in values.T]
        return np.column_stack(sums) / count[:, None]

    return Cells(means(place), means(heights), count, cell)


def covered_places(
    place: NDArray[np.float64], *, within: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Centres (m, 2) of the cells that hold points at places (n, 2) or lie between such cells.

    Of the morphological closing by a disk of five cells, within the rectangle of other places
    (k, 2): a cell whose only point is missing counts as before.
    """
    first = np.floor(place.min(axis=0) / CELL)
    index = (np.floor(place / CELL) - first).astype(np.intp)
    margin = DISK.shape[0] // 2
    held = np.zeros(index.max(axis=0) + 1 + 2 * margin, dtype=np.uint8)
    held[tuple((index + margin).T)] = 1
    closed = np.argwhere(cv2.morphologyEx(held, cv2.MORPH_CLOSE, DISK)) - margin
    centres = (first + closed + 0.5) * CELL
    low, high = within.min(axis=0), within.max(axis=0)
    return np.asarray(centres[((centres >= low) & (centres <= high)).all(axis=1)])


@dataclass(frozen=True, eq=False)
class SmoothHeights:
    """Surfaces through columns of heights."""

    heights: NDArray[np.float64]  # (n, k), at the data
    bends: NDArray[np.float64]  # (m, k), (Q_uu + Q_ww)/2 where bends were asked for


@dataclass(frozen=True, eq=False)
class HeightMap:
    """Normal equations of B-spline surfaces Q(u, w) through columns of heights over a rectangle."""

    data: Rows
    bend: Rows  # of (Q_uu + Q_ww)/2, at m places
    bands: NDArray[np.float64]  # (band + 1, net.size)
    side: NDArray[np.float64]  # (net.size, k)
    size: tuple[float, float]  # of the rectangle

    @classmethod
    def of(
        cls,
        net: Net,
        place: NDArray[np.float64],
        heights: NDArray[np.float64],
        *,
        bends_at: NDArray[np.float64] | None = None,
    ) -> Self | None:
        """Map of heights (n, k) at places (n, 2); None where the places lie on an upright line.

        bends_at (m, 2) are places within the data's rectangle; by default the data's own.
        """
        low, size = place.min(axis=0), np.ptp(place, axis=0)
        if size.min() <= 0:
            return None
        u, w = ((place - low) / size).T
        data = rows(net, evaluate(net.u, u), evaluate(net.w, w))
        bands, side = normal_equations(data, heights)
        u, w = (u, w) if bends_at is None else ((bends_at - low) / size).T
        straight = evaluate(net.u, u), evaluate(net.w, w)
        bend = rows(net, *straight)
        bend_u = bend.like(evaluate(net.u, u, derivative=2), straight[1]).products / size[0] ** 2
        bend_w = bend.like(straight[0], evaluate(net.w, w, derivative=2)).products / size[1] ** 2
        bend = replace(bend, products=(bend_u + bend_w) / 2)
        return cls(data, bend, bands, side, (float(size[0]), float(size[1])))

    def fit(self, smoothing: float) -> SmoothHeights | None:
        """Surfaces of a smoothing length: waves much shorter are flattened.

        None where the data leave the surface undetermined.
        """
        penalty = bending(self.data.net, *self.size)
        factor = factorise(self.bands + len(self.data.first) * smoothing**4 * penalty)
        if factor is None:
            return None
        vertices = factor.solve(self.side)
        return SmoothHeights(self.data.at(vertices), self.bend.at(vertices))
