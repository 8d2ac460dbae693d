"""The pixels within a polygon."""

import numpy as np
from numpy.typing import NDArray

Window = tuple[slice, slice]


def inside_of(
    x: NDArray[np.float64], y: NDArray[np.float64], shape: tuple[int, ...]
) -> tuple[Window, NDArray[np.bool_]]:
    """The pixels whose centres lie within a closed polygon, as a window of the frame and its mask.

    x and y (n,) are the corners, pixel centres at whole numbers. A centre is inside where an odd
    number of edges crosses its row to its left. The window is clipped to the frame of that shape.
    """
    top, bottom = max(0, int(np.ceil(y.min()))), min(shape[0], int(np.floor(y.max())) + 1)
    left, right = max(0, int(np.ceil(x.min()))), min(shape[1], int(np.floor(x.max())) + 1)
    if bottom <= top or right <= left:
        return np.s_[0:0, 0:0], np.zeros((0, 0), dtype=bool)
    rows = np.arange(top, bottom)
    nx, ny = np.roll(x, -1), np.roll(y, -1)
    # an edge owns the row of its upper end and not that of its lower, so that none counts twice
    edge, row = np.nonzero((y[:, None] <= rows) != (ny[:, None] <= rows))
    share = (rows[row] - y[edge]) / (ny[edge] - y[edge])
    crossing = np.ceil(x[edge] + share * (nx[edge] - x[edge])).astype(np.intp) - left
    width = right - left
    crossing = np.clip(crossing, 0, width)
    turns = np.bincount(row * (width + 1) + crossing, minlength=len(rows) * (width + 1))
    turns = turns.reshape(len(rows), width + 1)[:, :width].astype(np.uint8)
    return np.s_[top:bottom, left:right], np.cumsum(turns, axis=1, dtype=np.uint8) % 2 == 1
