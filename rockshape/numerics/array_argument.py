"""Array argument: what a caller gives for an array, masked elements replaced."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rockshape.errors import InputError


def array_argument(name: str, value: ArrayLike) -> NDArray[Any]:
    """Array of an argument; masked elements are NaN in floats, 0 in anything else.

    Raises: InputError for nested lists whose lengths differ.
    """
    if isinstance(value, np.ma.MaskedArray):
        return np.asarray(value.filled(np.nan if value.dtype.kind == "f" else 0))
    try:
        return np.asarray(value)
    except ValueError:
        raise InputError(
            f"{name}: expected an array, found one of rows that differ in length"
        ) from None
