"""Silhouettes: each rock's complete outline as a mask, stored no larger than the rock."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import overload

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Mask


@dataclass(frozen=True, eq=False)
class Cutout:
    """Mask of a part of a frame, outside of which nothing is set."""

    mask: Mask  # (rows, cols) of the window
    window: tuple[slice, slice]  # rows and columns of the frame
    shape: tuple[int, ...]  # of the frame

    def count_px(self) -> int:
        """Number of pixels that are set."""
        return int(np.count_nonzero(self.mask))

    def whole(self) -> Mask:
        """Mask of the frame."""
        frame = np.zeros(self.shape, dtype=bool)
        frame[self.window] = self.mask
        return frame

    def bounds(self) -> tuple[int, int, int, int] | None:
        """First column and row that hold a pixel, and those after the last; None without any."""
        rows, cols = np.flatnonzero(self.mask.any(axis=1)), np.flatnonzero(self.mask.any(axis=0))
        if not len(rows):
            return None
        top, left = (side.start for side in self.window)
        return (
            left + int(cols[0]),
            top + int(rows[0]),
            left + int(cols[-1]) + 1,
            top + int(rows[-1]) + 1,
        )


class Silhouettes(Sequence[Mask]):
    """Silhouette masks (rows, cols), made when asked for, since most of each is empty."""

    def __init__(self, labels: NDArray[np.uint16], boxes_px: Sequence[NDArray[np.float64]]) -> None:
        self._shape = labels.shape
        self._windows = [self._window(box) for box in boxes_px]
        self._masks = [labels[window] == index + 1 for index, window in enumerate(self._windows)]

    def replace(self, rocks: Iterable[int], labels: NDArray[np.uint16]) -> None:
        """Take some rocks' masks from another label image."""
        for index in rocks:
            self._masks[index] = labels[self._windows[index]] == index + 1

    def __len__(self) -> int:
        """Return the number of rocks."""
        return len(self._masks)

    @overload
    def __getitem__(self, index: int) -> Mask: ...
    @overload
    def __getitem__(self, index: slice) -> list[Mask]: ...
    def __getitem__(self, index: int | slice) -> Mask | list[Mask]:
        """Return a rock's mask in the whole frame."""
        if isinstance(index, slice):
            return [self[number] for number in range(*index.indices(len(self)))]
        return self.cutout(index).whole()

    def cutout(self, index: int) -> Cutout:
        """Part of a rock's mask that may be set."""
        return Cutout(self._masks[index], self._windows[index], self._shape)

    def seen(self, index: int, labels: NDArray[np.uint16]) -> Cutout:
        """Visible part of a rock in a label image (rows, cols), where its mask may be set."""
        window = self._windows[index]
        return Cutout(labels[window] == index + 1, window, self._shape)

    def _window(self, box_px: NDArray[np.float64]) -> tuple[slice, slice]:
        """Part of the frame that holds a box; all of it where the box is unknown."""
        size = np.array(self._shape)[::-1]
        low, high = np.zeros(2, dtype=int), size
        if not np.isnan(box_px).any():
            low = np.clip(np.floor(box_px[:2]).astype(int) - 1, 0, size)
            high = np.clip(np.ceil(box_px[2:]).astype(int) + 2, 0, size)
        (left, top), (right, bottom) = low.tolist(), high.tolist()
        return slice(top, bottom), slice(left, right)
