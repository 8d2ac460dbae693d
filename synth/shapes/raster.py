"""Rasterization of closed outlines: enclosed pixels, and a cell of the picture in ink."""

import cv2
import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats

PAPER = 236  # grey levels
_FILL, _INK = 168, 40
_SUBPIXELS = 4
_PEN_WIDTH_PX = 2.5
_SHIFT_BITS = 8


def enclosed_pixels(outline_px: Floats, shape: tuple[int, int]) -> NDArray[np.bool_]:
    """Mask (rows, cols) of pixels whose centres a closed outline encloses, by the even-odd rule.

    `outline_px` is (n, 2): column, row. Each edge flips, in every row that it crosses, all pixels
    from its crossing on; a centre on an edge belongs to what lies to the right of it.
    """
    start, end = outline_px, np.roll(outline_px, -1, axis=0)
    ends = np.ceil(np.sort([start[:, 1], end[:, 1]], axis=0)).astype(int)
    low, high = np.clip(ends, 0, shape[0])  # rows that an edge crosses: low ≤ row < high
    count = high - low
    edge = np.repeat(np.arange(len(start)), count)
    row = np.arange(len(edge)) - np.repeat(np.cumsum(count) - high, count)
    (x, y), (across, down) = start[edge].T, (end - start)[edge].T
    column = np.ceil(x + (row - y) * across / down).astype(int)
    flips = np.zeros((shape[0], shape[1] + 1), dtype=bool)
    np.logical_xor.at(flips, (row, np.clip(column, 0, shape[1])), True)
    return np.asarray(np.logical_xor.accumulate(flips, axis=1)[:, :-1])


def inked_cell(outline_px: Floats, cell_px: int) -> NDArray[np.uint8]:
    """Picture (cell_px, cell_px) of one shape: filled, its outline drawn."""
    fine = np.full((cell_px * _SUBPIXELS, cell_px * _SUBPIXELS), PAPER, dtype=np.uint8)
    subpixels = (outline_px + 0.5) * _SUBPIXELS - 0.5
    fixed = np.rint(subpixels * 2**_SHIFT_BITS).astype(np.int32).reshape(-1, 1, 2)
    cv2.fillPoly(fine, [fixed], _FILL, lineType=cv2.LINE_8, shift=_SHIFT_BITS)
    cv2.polylines(
        fine,
        [fixed],
        isClosed=True,
        color=_INK,
        thickness=round(_PEN_WIDTH_PX * _SUBPIXELS),
        lineType=cv2.LINE_8,
        shift=_SHIFT_BITS,
    )
    blocks = fine.reshape(cell_px, _SUBPIXELS, cell_px, _SUBPIXELS).mean(axis=(1, 3))
    return np.asarray(np.rint(blocks), dtype=np.uint8)
