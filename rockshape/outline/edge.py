"""The edge of a rock: the sides of its pixels that face outward, without the half-pixel inset."""

import numpy as np
from numpy.typing import NDArray

from rockshape.outline.trace import signed_area, trace_outline

# the eight neighbours (x, y), clockwise as seen from the right; even ones share a side
_STEPS = np.array([[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]])
_BEARING = np.zeros((3, 3), dtype=np.intp)  # of a step, by its y + 1 and x + 1
_BEARING[_STEPS[:, 1] + 1, _STEPS[:, 0] + 1] = np.arange(8)


def _outward(arriving: int, leaving: int) -> list[int]:
    """The sides passed when a pixel is entered by one bearing and left by another."""
    back = arriving + 4
    sweep = (leaving - back) % 8 or 8
    return [(back + turn) % 8 for turn in range(1, sweep) if (back + turn) % 2 == 0]


_SIDES = np.array(
    [[(_outward(a, b) + [0] * 4)[:4] for b in range(8)] for a in range(8)], dtype=np.intp
)
_COUNTS = np.array([[len(_outward(a, b)) for b in range(8)] for a in range(8)], dtype=np.intp)


def trace_edge(mask: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Middles of the outward sides of the boundary pixels of the mask's largest part, clockwise.

    mask is (rows, cols). The result is (n, 2) as (x, y) = (column, row) in pixels, n the number of
    pixel sides round the part: the 0.5 level of the mask by marching squares. Unlike the centres
    of the boundary pixels it lies on the edge on average, at any slope. The polygon through the
    points is half a pixel² smaller than the part with its holes filled: it cuts four more corners
    than it fills, by 1/8 each. (0, 2) for an empty mask.
    """
    return edge_of(trace_outline(mask))


def edge_of(outline_px: NDArray[np.float64]) -> NDArray[np.float64]:
    """Edge of an outline (m, 2) of neighbouring pixel centres, traced either way; see `trace_edge`.

    Between the step to a pixel and the step from it, all neighbours on the outer hand lie outside
    the part; each of them that shares a side with the pixel gives that side.
    """
    if len(outline_px) < 2:
        sides = np.array([4, 6, 0, 2], dtype=np.intp)[: 4 * len(outline_px)]
        return np.asarray(np.repeat(outline_px, 4, axis=0) + _STEPS[sides] / 2)
    if signed_area(outline_px) < 0:
        outline_px = outline_px[::-1]
    steps = np.diff(outline_px, axis=0, append=outline_px[:1]).astype(np.intp) + 1
    leaving = _BEARING[steps[:, 1], steps[:, 0]]
    arriving = np.roll(leaving, 1)
    counts = _COUNTS[arriving, leaving]
    owner = np.repeat(np.arange(len(counts)), counts)
    turn = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    side = _SIDES[arriving[owner], leaving[owner], turn]
    return np.asarray(outline_px[owner] + _STEPS[side] / 2)
