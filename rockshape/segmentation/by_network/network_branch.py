"""Rocks that the network finds in a picture, in colour where there is any."""

from collections.abc import Iterator
from itertools import product

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Labels, Mask
from rockshape.observation import Observation
from rockshape.rock.instances import Window
from rockshape.segmentation.by_network.instances import cut_rocks
from rockshape.segmentation.by_network.picture import as_fractions, levels_of
from rockshape.segmentation.by_network.scales import joint_answer
from rockshape.segmentation.placement import largest_first, place_among

WINDOW_PX = 2048  # of a side, searched at once: what it takes of memory grows with the area
OVERLAP_PX = 256  # to either side; a wider rock may be cut at a window's edge


def find_by_network(observation: Observation) -> Labels:
    """Labels (rows, cols) from 1 of the rocks that the network finds, whatever the range.

    Large pictures are searched window by window. A rock is taken from the window in whose own part
    its middle lies.
    """
    picture = picture_of(observation)
    levels = levels_of(picture)
    rows, cols = picture.shape[:2]
    if max(rows, cols) <= WINDOW_PX + 2 * OVERLAP_PX:
        return cut_rocks(joint_answer(as_fractions(picture, levels)))
    found = np.zeros((rows, cols), dtype=np.int32)
    for row, col in product(range(0, rows, WINDOW_PX), range(0, cols, WINDOW_PX)):
        found = place_among(found, None, _of_window(picture, levels, row, col))
    return found


def _of_window(
    picture: NDArray[np.generic], levels: tuple[float, float], row: int, col: int
) -> Iterator[tuple[Window, Mask]]:
    """Rocks whose middle is in the window that begins at a row and column, the largest first."""
    top, left = max(row - OVERLAP_PX, 0), max(col - OVERLAP_PX, 0)
    part = picture[top : row + WINDOW_PX + OVERLAP_PX, left : col + WINDOW_PX + OVERLAP_PX]
    found = cut_rocks(joint_answer(as_fractions(part, levels)))
    for (down, across), mask in largest_first(found):
        window = (
            slice(down.start + top, down.stop + top),
            slice(across.start + left, across.stop + left),
        )
        middle = [(side.start + side.stop) // 2 for side in window]
        if row <= middle[0] < row + WINDOW_PX and col <= middle[1] < col + WINDOW_PX:
            yield window, mask


def picture_of(observation: Observation) -> NDArray[np.generic]:
    """Picture (rows, cols, 3) in colour, else (rows, cols) in grey."""
    colour = observation.colour
    if colour is None or colour.ndim != 3 or colour.shape[2] < 3:
        return observation.image
    return np.asarray(colour[..., :3])
