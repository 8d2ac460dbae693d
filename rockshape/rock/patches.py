"""The pixels of each rock in a label image."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Patch:
    """A rock's pixels: the largest part that hangs together."""

    number: int
    window: tuple[slice, slice]  # the box they lie in
    mask: NDArray[np.bool_]  # within the box


def find_patches(labels: NDArray[np.integer]) -> list[Patch]:
    """The pixels of each number but 0 in a label image (rows, cols), in the order of the numbers.

    Of a number in several pieces, which touch by corners too, the largest.
    """
    return [
        _largest_part(number, window, labels[window] == number)
        for number, window in _windows(labels)
    ]


def _windows(labels: NDArray[np.integer]) -> list[tuple[int, tuple[slice, slice]]]:
    """Each number but 0 and the box of its pixels, from the runs of equal pixels in each row."""
    rows, cols = labels.shape
    bordered = np.zeros((rows, cols + 2), dtype=labels.dtype)
    bordered[:, 1:-1] = labels
    row, start = np.nonzero(bordered[:, 1:] != bordered[:, :-1])
    value = labels[row, np.minimum(start, cols - 1)]
    # a run ends where the next change is, in the same row: the border of each is 0
    rock = np.flatnonzero((start < cols) & (value != 0))
    row, end, start, value = row[rock], start[rock + 1], start[rock], value[rock]
    order = np.argsort(value, kind="stable")
    first = np.flatnonzero(np.diff(value[order], prepend=0))
    sides = [
        least.reduceat(places[order], first) if len(first) else first
        for least, places in (
            (np.minimum, row),
            (np.maximum, row + 1),
            (np.minimum, start),
            (np.maximum, end),
        )
    ]
    return [
        (number, (slice(top, bottom), slice(left, right)))
        for number, top, bottom, left, right in zip(
            value[order][first].tolist(), *(side.tolist() for side in sides), strict=True
        )
    ]


def _largest_part(number: int, window: tuple[slice, slice], mask: NDArray[np.bool_]) -> Patch:
    count, parts, stats, _ = cv2.connectedComponentsWithStats(mask.view(np.uint8), connectivity=8)
    if count == 2:
        return Patch(number, window, mask)
    largest = 1 + int(np.argmax(stats[1:, cv2.CC_STAT_AREA]))
    left, top, width, height = stats[largest, : cv2.CC_STAT_AREA].tolist()
    rows, cols = window
    inner = slice(top, top + height), slice(left, left + width)
    return Patch(
        number,
        (
            slice(rows.start + top, rows.start + top + height),
            slice(cols.start + left, cols.start + left + width),
        ),
        parts[inner] == largest,
    )
