"""Rock instances of one image: a mask and an id for each, which may overlap."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

Window = tuple[slice, slice]


@dataclass(frozen=True, eq=False)
class Instance:
    """One rock's pixels, and its outline where that is known to sub-pixel."""

    id: int  # as its file has it, else from 1 in reading order
    window: Window  # rows and columns of the image
    mask: NDArray[np.bool_]  # (rows, cols) within the window
    outline_px: NDArray[np.float64] | None = None  # (n, 2) as (x, y), closed; None: the mask's edge


@dataclass(frozen=True, eq=False)
class Instances:
    """The rocks of an image of a shape (rows, cols), in the order of their ids; may overlap."""

    shape: tuple[int, int]
    items: tuple[Instance, ...] = ()

    def __len__(self) -> int:
        return len(self.items)

    def __iter__(self) -> Iterator[Instance]:
        return iter(self.items)

    def __getitem__(self, index: int) -> Instance:
        return self.items[index]

    @classmethod
    def from_labels(cls, labels: NDArray[np.integer]) -> Self:
        """Instances of a label image (rows, cols); 0 is the ground, any other value an id."""
        items = tuple(
            Instance(number, window, labels[window] == number)
            for number, window in _windows(labels)
        )
        return cls((labels.shape[0], labels.shape[1]), items)

    def to_labels(self) -> NDArray[np.int32]:
        """Label image (rows, cols) with each rock's id, 0 the ground; later rocks cover earlier."""
        labels = np.zeros(self.shape, dtype=np.int32)
        for item in self.items:
            labels[item.window][item.mask] = item.id
        return labels


def _windows(labels: NDArray[np.integer]) -> list[tuple[int, Window]]:
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
