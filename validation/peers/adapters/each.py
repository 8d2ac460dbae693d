"""A peer that measures one mask, on each rock of a label image."""

from collections.abc import Callable, Mapping

import numpy as np
import scipy.ndimage as ndi
from numpy.typing import NDArray

MARGIN_PX = 4  # of ground round each mask: no rock touches the border of its picture


def of_each_rock(
    labels: NDArray[np.int32], measure_mask: Callable[[NDArray[np.bool_]], Mapping[str, float]]
) -> dict[str, list[float]]:
    """Return each column of `measure_mask` for every rock, in the order of the numbers.

    A mask is the largest piece that hangs together, as for our own measures.
    """
    columns: dict[str, list[float]] = {}
    for number, window in enumerate(ndi.find_objects(labels), start=1):
        if window is None:
            continue
        pieces, count = ndi.label(labels[window] == number, structure=np.ones((3, 3)))
        largest = 1 + int(np.argmax(np.bincount(pieces.ravel(), minlength=count + 1)[1:]))
        for column, value in measure_mask(np.pad(pieces == largest, MARGIN_PX)).items():
            columns.setdefault(column, []).append(float(value))
    return columns
