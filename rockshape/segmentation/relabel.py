"""The numbers of a label image."""

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.strips import ROWS, by_strips


def renumber(labels: NDArray[np.int32], *, dropped: NDArray[np.integer]) -> NDArray[np.int32]:
    """Number the rocks from 1 in reading order, without those dropped and without gaps."""
    numbers = in_reading_order(labels)
    numbers = numbers[~np.isin(numbers, dropped)]
    new = np.zeros(int(labels.max(initial=0)) + 1, dtype=np.int32)
    new[numbers] = np.arange(1, len(numbers) + 1)
    return relabelled(labels, new)


def relabelled(labels: NDArray[np.int32], new: NDArray[np.int32]) -> NDArray[np.int32]:
    """Labels (rows, cols) with new[number] in place of each number."""
    return by_strips(lambda strip: new[strip], labels)


def in_reading_order(labels: NDArray[np.int32]) -> NDArray[np.intp]:
    """The numbers above 0 in a label image, in the order of their first pixels."""
    first = np.full(int(labels.max(initial=0)) + 1, -1, dtype=np.intp)
    for top in reversed(range(0, len(labels), ROWS)):
        strip = labels[top : top + ROWS].ravel()
        backwards = np.flatnonzero(strip)[::-1]
        # of a number's pixels the last one set stays
        first[strip[backwards]] = top * labels.shape[1] + backwards
    numbers = np.flatnonzero(first >= 0)
    return np.asarray(numbers[np.argsort(first[numbers])])


def label_areas(labels: NDArray[np.int32]) -> NDArray[np.int64]:
    """Pixels of each number from 0 in labels (rows, cols), of which none is negative."""
    areas = np.zeros(int(labels.max(initial=0)) + 1, dtype=np.int64)
    for top in range(0, len(labels), ROWS):
        areas += np.bincount(labels[top : top + ROWS].ravel(), minlength=len(areas))
    return areas
