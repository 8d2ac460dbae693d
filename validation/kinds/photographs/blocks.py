"""Blocks of a picture: what the bootstrap draws, so that neighbours stay together."""

import math
from dataclasses import dataclass

import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray

from validation.arrays import Labels


@dataclass(frozen=True)
class Blocks:
    """Squares of a picture, numbered along its rows; the whole picture without a side."""

    shape: tuple[int, int]
    side_px: int | None

    @property
    def _side(self) -> int:
        return self.side_px or max(self.shape)

    @property
    def _across(self) -> int:
        return math.ceil(self.shape[1] / self._side)

    @property
    def count(self) -> int:
        """Number of blocks."""
        return math.ceil(self.shape[0] / self._side) * self._across

    def of_pixels(self) -> NDArray[np.intp]:
        """Block of each pixel, (rows, cols)."""
        row, col = (np.arange(size) // self._side for size in self.shape)
        return row[:, None] * self._across + col

    def of_labels(self, labels: Labels) -> dict[int, int]:
        """Block of the middle of each label's window, by its number."""
        blocks = {}
        for number, window in enumerate(ndi.find_objects(labels), start=1):
            if window is not None:
                row, col = ((side.start + side.stop - 1) // 2 // self._side for side in window)
                blocks[number] = row * self._across + col
        return blocks
