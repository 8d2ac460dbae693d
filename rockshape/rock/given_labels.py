"""Instances of labels that a caller gives as an array."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rockshape.errors import InputError
from rockshape.numerics.array_argument import array_argument
from rockshape.rock.grey_levels import grey_levels
from rockshape.rock.instances import MAX_ID, MAX_LABEL, Instances
from rockshape.rock.pieces import Pieces, split_pieces


def instances_of(labels: ArrayLike | Instances, pieces: Pieces = "split") -> Instances:
    """Instances of a label image (rows, cols), 0 the ground; instances as they are.

    Raises: InputError for another shape, fractions, ids out of range and grey levels.
    """
    if isinstance(labels, Instances):
        return labels
    numbers = _whole(array_argument("labels", labels))
    picture = grey_levels(numbers)
    if picture is not None:
        raise InputError(f"labels: {picture}")
    return split_pieces(Instances.from_labels(numbers), pieces)


def _whole(labels: NDArray[np.generic]) -> NDArray[np.integer]:
    if labels.ndim != 2 or labels.dtype.kind not in "biu":
        raise InputError(
            f"labels: expected (rows, cols) of whole numbers, "
            f"found {labels.shape} of {labels.dtype}"
        )
    low, high = (int(labels.min()), int(labels.max())) if labels.size else (0, 0)
    if low < 0 or high > MAX_ID:
        raise InputError(f"labels: expected 0 to {MAX_ID}, found {low} to {high}")
    return labels.astype(np.int32 if high <= MAX_LABEL else np.int64)
