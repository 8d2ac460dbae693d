"""Grain seen obliquely: the heights of its near side, its upper and its lower one, and its outline.

In each column of samples, the chain of points runs from the far end of the upper side over the rim
to the far end of the lower side.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats, Singles
from synth.bed.relief.packing import Footprint, Grain, cut_maps, window_of
from synth.bed.view.chain import crossings, surface_envelope
from synth.bed.view.frame import ObliqueFrame

_FAR = np.float32(1e6)  # row of a point that is not there


@dataclass(frozen=True, eq=False)
class Silhouette:
    """Grain in the view, as far as that goes, as if nothing lay over it."""

    first: tuple[int, int]  # row and column of the mask's first sample
    mask: NDArray[np.bool_]
    height_px: Singles  # like the mask
    corners_px: Floats  # (n, 2), outline in the tile, also beyond the view


_UNSEEN = Silhouette(
    (0, 0), np.zeros((0, 0), dtype=bool), np.zeros((0, 0), np.float32), np.zeros((0, 2))
)


@dataclass(frozen=True, eq=False)
class _Sides:
    """Chains of a grain's points, (2 n, columns), a column of samples each."""

    rows: Singles  # of the view
    envelope: Singles  # of the rows, from the outline's upper edge to its lower
    height_px: Singles
    present: NDArray[np.bool_]  # (columns,), whether the grain is there

    def cut(self, columns: slice) -> "_Sides":
        """Sides in some of the columns."""
        return _Sides(
            np.ascontiguousarray(self.rows[:, columns]),
            np.ascontiguousarray(self.envelope[:, columns]),
            np.ascontiguousarray(self.height_px[:, columns]),
            self.present[columns],
        )


def silhouette(grain: Grain, place: Footprint, frame: ObliqueFrame) -> Silhouette:
    """Silhouette of a grain that lies in its place; empty where the view does not reach."""
    if not place.mask.any():
        return _UNSEEN
    middle = (place.centre_px + frame.margin_px) * frame.per_px
    ends = grain.body.hull @ grain.stretch.T
    left, top, right, bottom = window_of(ends, middle, frame.per_px)
    maps = cut_maps(grain, middle, frame.per_px, left=left, top=top, right=right, bottom=bottom)
    x = np.arange(left, right, dtype=np.float32) - np.float32(middle[0])
    y = np.arange(top, bottom, dtype=np.float32) - np.float32(middle[1])
    sides = _sides(grain, place, frame, maps, x=x, y=y, middle=float(middle[1]))
    seen = np.flatnonzero(sides.present)
    if not seen.size:
        return _UNSEEN
    upper, lower = sides.envelope[0], sides.envelope[-1]
    begin = max(int(np.floor(upper[seen].min())), 0)
    end = min(int(np.ceil(lower[seen].max())) + 1, frame.shape[0])
    one, two = max(-left, 0), min(frame.shape[1] - left, len(x))
    if begin >= end or one >= two:
        return _UNSEEN
    part = sides.cut(slice(one, two))
    level = np.arange(begin, end, dtype=np.float32)[:, None]
    mask = (level >= part.envelope[0]) & (level <= part.envelope[-1]) & part.present
    met = crossings(part.rows, part.envelope, begin, end - begin)
    tips = _tips(grain, place, frame, middle)
    corners = np.concatenate(
        [
            tips[:1],
            np.column_stack([seen + left, upper[seen]]),
            tips[1:],
            np.column_stack([seen + left, lower[seen]])[::-1],
        ]
    )
    return Silhouette(
        first=(begin, left + one),
        mask=mask,
        height_px=met.at(part.height_px),
        corners_px=corners / frame.per_px - frame.margin_px,
    )


def _sides(
    grain: Grain,
    place: Footprint,
    frame: ObliqueFrame,
    maps: Singles,
    *,
    x: Singles,
    y: Singles,
    middle: float,
) -> _Sides:
    """Sides over a window whose samples lie at (x, y) from the grain's middle, itself in a row."""
    inner = np.float32(1.0) - maps[..., 0]
    inside = inner > 0.0
    count, columns = inside.shape
    down = np.repeat(y[:, None], columns, axis=1)
    # What lies beyond the near rim is drawn in to it; beyond the far one nothing is met.
    there = inside | _drawn_to_the_rim(inner, inside, down)
    root = np.sqrt(np.maximum(inner, np.float32(0.0))) * np.float32(grain.half_thickness_px)
    step = np.float32(1.0 / frame.per_px)
    slant = place.lean[1] * (down * step) + place.lean[0] * (x * step)
    slant += np.float32(place.base_px)
    height = np.concatenate([slant + maps[..., 1] * root, (slant - maps[..., 2] * root)[::-1]])
    bed_rows = down + np.float32(middle)
    rows = frame.rows(np.concatenate([bed_rows, bed_rows[::-1]]), height)
    nearest = count - 1 - np.argmax(there[::-1], axis=0)
    column = np.arange(columns)
    beyond = np.arange(count)[:, None] > nearest
    absent = ~there & ~beyond
    beyond = np.concatenate([beyond, beyond[::-1]])
    rows = np.where(beyond, rows[nearest, column], rows)
    height = np.where(beyond, height[nearest, column], height)
    rows[:count][absent] = _FAR
    rows[count:][absent[::-1]] = -_FAR
    envelope = np.empty_like(rows)
    envelope[:count] = surface_envelope(rows[:count])
    envelope[count:] = np.maximum.accumulate(rows[count:], axis=0)
    return _Sides(rows, envelope, height, np.asarray(inside.any(axis=0)))


def _drawn_to_the_rim(
    inner: Singles, inside: NDArray[np.bool_], down: Singles
) -> NDArray[np.bool_]:
    """Mask of the samples just outside in a column, which are moved to the outline in place."""
    rim = np.zeros_like(inside)
    for out, within, towards in (
        (slice(None, -1), slice(1, None), 1.0),
        (slice(1, None), slice(None, -1), -1.0),
    ):
        edge = inside[within] & ~inside[out]
        gap = inner[out][edge] / (inner[out][edge] - inner[within][edge])
        down[out][edge] += np.float32(towards) * gap
        rim[out] |= edge
    return rim


def _tips(grain: Grain, place: Footprint, frame: ObliqueFrame, middle: Floats) -> Floats:
    """Leftmost and rightmost points of the rim, in the view's samples, (2, 2)."""
    ends = grain.body.outline @ grain.stretch.T
    tips = ends[[int(np.argmin(ends[:, 0])), int(np.argmax(ends[:, 0]))]]
    height = (place.base_px + tips @ place.lean).astype(np.float32)
    tips = middle + frame.per_px * tips
    return np.column_stack([tips[:, 0], frame.rows(tips[:, 1], height)])
