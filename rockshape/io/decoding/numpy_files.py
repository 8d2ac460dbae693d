"""NumPy array files; objects in them are never unpickled."""

import io
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

NPY_MAGIC = b"\x93NUMPY"
ZIP_MAGIC = b"PK\x03\x04"


def load_npy(file: "InputFile") -> NDArray[np.generic]:
    """Array of an .npy file. Raises: InputError for pickled objects, ValueError for damage."""
    with _unpickled(file):
        return np.asarray(np.load(io.BytesIO(file.data), allow_pickle=False))


def load_npz(file: "InputFile", keys: Collection[str]) -> NDArray[np.generic]:
    """Array of an .npz file under the first of the keys that it has; others are not read.

    Raises: InputError where it has none of the keys or holds pickled objects.
    """
    with _unpickled(file), np.load(io.BytesIO(file.data), allow_pickle=False) as members:
        key = next((key for key in keys if key in members.files), None)
        if key is None:
            found = ", ".join(members.files) or "nothing"
            raise InputError(f"{file.path}: expected the key {' or '.join(keys)}, found {found}")
        return np.asarray(members[key])


@contextmanager
def _unpickled(file: "InputFile") -> Iterator[None]:
    try:
        yield
    except ValueError as error:
        if "pickle" not in str(error):
            raise
        raise file.refusal("pickled objects, which are never loaded") from None
