"""Tile: a made picture with the rock that each pixel shows."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

SIDE_PX = 256


@dataclass(frozen=True, eq=False)
class Tile:
    """Part of a made picture."""

    image: NDArray[np.uint8]  # (side, side, 3): red, green, blue
    labels: NDArray[np.uint16]  # (side, side), 0 where no rock is


def cut_tiles(image: NDArray[np.uint8], labels: NDArray[np.generic]) -> list[Tile]:
    """Tiles of a picture (rows, cols, 3) side by side, from its middle; none of a smaller one."""
    rows, cols = (size // SIDE_PX for size in labels.shape)
    top, left = (
        (size - count * SIDE_PX) // 2
        for size, count in zip(labels.shape, (rows, cols), strict=True)
    )
    windows = [
        np.s_[top + row * SIDE_PX :, left + col * SIDE_PX :]
        for row in range(rows)
        for col in range(cols)
    ]
    return [
        Tile(
            np.ascontiguousarray(image[window][:SIDE_PX, :SIDE_PX]),
            _renumbered(labels[window][:SIDE_PX, :SIDE_PX]),
        )
        for window in windows
    ]


def _renumbered(labels: NDArray[np.generic]) -> NDArray[np.uint16]:
    values, inverse = np.unique(labels, return_inverse=True)
    numbers = np.cumsum(values > 0).astype(np.uint16) * (values > 0)
    return np.asarray(numbers[inverse].reshape(labels.shape), dtype=np.uint16)
