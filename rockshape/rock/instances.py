"""Rock instances of one image: a mask and an id for each, which may overlap."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import cv2
import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError
from rockshape.numerics.strips import by_strips

MAX_LABEL = 2**31 - 1  # of a label image
MAX_ID = 2**63 - 1  # of a rock: what a table of whole numbers holds
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
    """The rocks of an image of a shape (rows, cols), which may overlap.

    notes say, each in a few words, what of a file was left out or read otherwise than it stands.
    Raises: InputError for ids that repeat and masks that do not fit their window of the image.
    """

    shape: tuple[int, int]
    items: tuple[Instance, ...] = ()
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if len({item.id for item in self.items}) < len(self.items):
            raise InputError("instances: expected each id once, found one repeated")
        for item in self.items:
            expected = tuple(
                side.stop - side.start
                for side, size in zip(item.window, self.shape, strict=True)
                if 0 <= side.start < side.stop <= size
            )
            if item.mask.shape != expected:
                raise InputError(
                    f"instances: rock {item.id}: expected a mask that fills its window of the "
                    f"image {self.shape}, found {item.mask.shape} for {item.window}"
                )

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
        """Label image (rows, cols) with each rock's id, 0 the ground; later rocks cover earlier.

        Raises: InputError for an id that is not in 1..2147483647.
        """
        wrong = next((item.id for item in self.items if not 0 < item.id <= MAX_LABEL), None)
        if wrong is not None:
            raise InputError(
                f"labels: expected ids from 1 to {MAX_LABEL} for a label image, found {wrong}"
            )
        labels = np.zeros(self.shape, dtype=np.int32)
        for item in self.items:
            labels[item.window][item.mask] = item.id
        return labels

    def meeting(self, window: Window) -> tuple[Instance, ...]:
        """Rocks whose window has a pixel in common with a window of the image."""
        rows, cols = window
        top, bottom, left, right = self._sides
        met = (top < rows.stop) & (bottom > rows.start) & (left < cols.stop) & (right > cols.start)
        return tuple(self.items[index] for index in np.flatnonzero(met))

    @cached_property
    def _sides(self) -> NDArray[np.intp]:
        """First and past-the-last row, then column, of every window, (4, n)."""
        sides = [
            (rows.start, rows.stop, cols.start, cols.stop)
            for rows, cols in (item.window for item in self.items)
        ]
        return np.array(sides, dtype=np.intp).reshape(-1, 4).T

    def largest_parts(self) -> Self:
        """The same rocks, each with the largest part of its mask alone (8-connected), in its box.

        Rocks without a pixel are left out.
        """
        return type(self)(
            self.shape,
            tuple(_largest_part(item) for item in self.items if item.mask.any()),
            self.notes,
        )


def _largest_part(instance: Instance) -> Instance:
    count, parts, stats, _ = cv2.connectedComponentsWithStats(
        np.ascontiguousarray(instance.mask).view(np.uint8), connectivity=8
    )
    largest = 1 + int(np.argmax(stats[1:, cv2.CC_STAT_AREA]))
    left, top, width, height = stats[largest, : cv2.CC_STAT_AREA].tolist()
    if count == 2 and (height, width) == instance.mask.shape:
        return instance
    rows, cols = instance.window
    return replace(
        instance,
        window=(
            slice(rows.start + top, rows.start + top + height),
            slice(cols.start + left, cols.start + left + width),
        ),
        mask=parts[top : top + height, left : left + width] == largest,
    )


def _changes(labels: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Between which neighbours in a row the number changes, (rows, cols + 1); beyond it is 0."""
    bordered = np.pad(labels, ((0, 0), (1, 1)))
    return np.asarray(bordered[:, 1:] != bordered[:, :-1])


def _windows(labels: NDArray[np.integer]) -> list[tuple[int, Window]]:
    """Each number but 0 and the box of its pixels, from the runs of equal pixels in each row."""
    cols = labels.shape[1]
    row, start = np.nonzero(by_strips(_changes, labels))
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
