"""Pickled NumPy arrays, loaded without anything that a pickle could execute."""

import io
import pickle
from typing import IO, Any

SAFE = {
    ("numpy", "dtype"),
    ("numpy", "ndarray"),
    ("_codecs", "encode"),
    *(
        (f"numpy.{core}.{module}", name)
        for core in ("core", "_core")
        for module, name in (
            ("multiarray", "_reconstruct"),
            ("multiarray", "scalar"),
            ("numeric", "_frombuffer"),
        )
    ),
}


class _NumpyUnpickler(pickle.Unpickler):
    """Unpickler that knows NumPy's arrays, types and scalars, and nothing else."""

    def find_class(self, module: str, name: str) -> Any:
        if (module, name) not in SAFE:
            raise pickle.UnpicklingError(f"{module}.{name}, which is not of NumPy's arrays")
        return super().find_class(module, name)


def load_numpy_pickle(stream: IO[bytes]) -> Any:
    """Content of a pickle of plain Python values and NumPy arrays.

    Raises: pickle.UnpicklingError for any other class or function; it is not called.
    """
    return _NumpyUnpickler(io.BytesIO(stream.read())).load()
