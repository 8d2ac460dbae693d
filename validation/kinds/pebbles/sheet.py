"""Sheet of pebbles: each mask by itself, so that no neighbour makes a part of its outline."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from validation.arrays import Labels
from validation.records.object_matching import whole_and_wide

MARGIN_PX = 4
Mask = NDArray[np.bool_]


def pebble_masks(labels: Labels, least_px: float) -> list[Mask]:
    """Mask (rows, cols) of each label that the frame does not cut and that is as wide as that."""
    return [labels == number for number in np.flatnonzero(whole_and_wide(labels, least_px))]


def shrunk(mask: Mask, factor: int) -> Mask:
    """Mask of pixels so many times as large, in where half of one is."""
    rows, cols = (side // factor for side in mask.shape)
    blocks = mask[: rows * factor, : cols * factor].reshape(rows, factor, cols, factor)
    return np.asarray(blocks.mean(axis=(1, 3)) >= 0.5)


def sheet(masks: Sequence[Mask]) -> Labels:
    """Labels (rows, cols) of the masks one below the other, mask i as i + 1."""
    windows = [np.pad(_window(mask), MARGIN_PX) for mask in masks]
    width = max((window.shape[1] for window in windows), default=1)
    rows = [
        np.pad(window, [(0, 0), (0, width - window.shape[1])]) * np.int32(number)
        for number, window in enumerate(windows, start=1)
    ]
    return np.concatenate(rows) if rows else np.zeros((1, 1), np.int32)


def _window(mask: Mask) -> Mask:
    rows, cols = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    if not rows.size:
        return np.zeros((1, 1), dtype=bool)
    return mask[rows[0] : rows[-1] + 1, cols[0] : cols[-1] + 1]
