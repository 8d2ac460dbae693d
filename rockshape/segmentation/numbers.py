"""The numbers of a label image."""

import numpy as np
from numpy.typing import NDArray


def renumber(labels: NDArray[np.int32], *, dropped: NDArray[np.integer]) -> NDArray[np.int32]:
    """Number the rocks from 1 in reading order, without those dropped and without gaps."""
    numbers, first = np.unique(labels, return_index=True)
    numbers = numbers[np.argsort(first)]
    numbers = numbers[(numbers > 0) & ~np.isin(numbers, dropped)]
    new = np.zeros(int(labels.max(initial=0)) + 1, dtype=np.int32)
    new[numbers] = np.arange(1, len(numbers) + 1)
    return new[labels]
