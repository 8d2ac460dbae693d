"""One thread for linear algebra while rocks are measured.

The matrices of a fit are small. Threads of BLAS wait on each other for longer than they work, and
on a busy machine many times as long.
"""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from threading import Lock
from typing import Any

from threadpoolctl import ThreadpoolController

_lock = Lock()
_limits: list[Any] = []  # one for each that is within `one_blas_thread`, the first the oldest


@cache
def _blas(*, with_scipy: bool) -> ThreadpoolController:  # noqa: ARG001 - the cache asks for it
    """The libraries loaded: numpy's, OpenCV's, and scipy's once it is imported."""
    return ThreadpoolController().select(user_api="blas")


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Let the BLAS libraries that are loaded use one thread, and as many as before afterwards.

    The number is the process's: where several threads are within at once, the last to leave sets
    back what the first found. A library that is loaded within keeps its number.
    """
    with _lock:
        loaded = _blas(with_scipy="scipy.linalg" in sys.modules)
        _limits.append(loaded.limit(limits=1))
    try:
        yield
    finally:
        with _lock:
            _limits.pop().restore_original_limits()
