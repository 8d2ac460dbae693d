"""Silhouettes: each rock's complete outline as a mask, stored no larger than the rock."""

from collections.abc import Iterable, Sequence
from typing import overload

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Mask


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
        mask = np.zeros(self._shape, dtype=bool)
        mask[self._windows[index]] = self._masks[index]
        return mask

    def _window(self, box_px: NDArray[np.float64]) -> tuple[slice, slice]:
        """Part of the frame that holds a box; all of it where the box is unknown."""
        if np.isnan(box_px).any():
            return slice(None), slice(None)
        low = np.maximum(np.floor(box_px[:2]).astype(int) - 1, 0)
        high = np.maximum(np.ceil(box_px[2:]).astype(int) + 2, 0)
        return slice(low[1], high[1]), slice(low[0], high[0])
