"""NumPy array files; objects in them are never unpickled."""

import io
import zipfile
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from math import prod
from typing import IO, TYPE_CHECKING

import numpy as np
from numpy.lib import format as npy_format
from numpy.typing import NDArray

from rockshape.errors import InputError

if TYPE_CHECKING:
    from rockshape.io.files import InputFile

NPY_MAGIC = b"\x93NUMPY"
ZIP_MAGIC = b"PK\x03\x04"
HEADERS = {(1, 0): npy_format.read_array_header_1_0, (2, 0): npy_format.read_array_header_2_0}


def load_npy(file: "InputFile") -> NDArray[np.generic]:
    """Array of an .npy file; its shape is checked before it is loaded.

    Raises: InputError for pickled objects and for more values than the file may have, ValueError
    for damage.
    """
    with _unpickled(file):
        return _array(file, io.BytesIO(file.data))


def load_npz(
    file: "InputFile", keys: Collection[str], *, or_the_only: bool = False
) -> NDArray[np.generic]:
    """Array of an .npz file under the first of the keys that it has; others are not read.

    With or_the_only it is the only array of the file, whatever its key.

    Raises: InputError where it has none of the keys, more values than the file may have or pickled
    objects.
    """
    with _unpickled(file), zipfile.ZipFile(io.BytesIO(file.data)) as members:
        names = [name.removesuffix(".npy") for name in members.namelist()]
        key = next((key for key in keys if key in names), None)
        if or_the_only and len(names) == 1:
            key = names[0]
        if key is None:
            found = ", ".join(names) or "nothing"
            raise InputError(f"{file.path}: expected the key {' or '.join(keys)}, found {found}")
        with members.open(members.namelist()[names.index(key)]) as member:
            return _array(file, member)


def _array(file: "InputFile", stream: IO[bytes]) -> NDArray[np.generic]:
    """Array of an open .npy stream; its header is read first."""
    version = npy_format.read_magic(stream)
    read_header = HEADERS.get(version)
    if read_header is None:
        raise ValueError(f"version {version} of the NPY format")
    shape, by_columns, dtype = read_header(stream)
    if dtype.hasobject:
        raise file.refusal("pickled objects, which are never loaded")
    file.check_shape(shape, item_bytes=dtype.itemsize)
    expected = prod(shape) * dtype.itemsize
    data = stream.read(expected)
    if len(data) != expected:
        raise ValueError(f"{len(data)} of {expected} bytes of an array {shape} of {dtype}")
    values = np.frombuffer(data, dtype)
    return values.reshape(shape, order="F" if by_columns else "C")


@contextmanager
def _unpickled(file: "InputFile") -> Iterator[None]:
    try:
        yield
    except ValueError as error:
        if "pickle" not in str(error):
            raise
        raise file.refusal("pickled objects, which are never loaded") from None
