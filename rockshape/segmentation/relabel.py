"""The numbers of a label image."""

import numpy as np
from numpy.typing import NDArray


def renumber(labels: NDArray[np.int32], *, dropped: NDArray[np.integer]) -> NDArray[np.int32]:
    """Number the rocks from 1 in reading order, without those dropped and without gaps."""
    numbers = in_reading_order(labels)
    numbers = numbers[~np.isin(numbers, dropped)]
    new = np.zeros(int(labels.max(initial=0)) + 1, dtype=np.int32)
    new[numbers] = np.arange(1, len(numbers) + 1)
    return new[labels]


def in_reading_order(labels: NDArray[np.int32]) -> NDArray[np.intp]:
    """The numbers above 0 in a label image, in the order of their first pixels."""
    backwards = np.flatnonzero(labels)[::-1]
    first = np.full(int(labels.max(initial=0)) + 1, -1, dtype=np.intp)
    first[labels.ravel()[backwards]] = backwards  # of a number's pixels the last one set stays
    numbers = np.flatnonzero(first >= 0)
    return np.asarray(numbers[np.argsort(first[numbers])])
