"""Fresh processes to render in, each kept to one thread: the processes are the parallelism."""

import os
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context

import cv2

# OpenBLAS, MKL, OpenMP and Mesa's llvmpipe read these when they are loaded.
ONE_THREAD = {
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "LP_NUM_THREADS": "1",
}


@contextmanager
def worker_pool(jobs: int) -> Iterator[ProcessPoolExecutor]:
    """Give so many processes that have no OpenGL yet.

    A process is spawned when work is submitted, with the environment of that moment, so the
    environment holds the limits as long as the pool is open. With one thread sums have one order
    too: the bytes do not depend on the number of processors.
    """
    before = {name: os.environ.get(name) for name in ONE_THREAD}
    os.environ.update(ONE_THREAD)
    try:
        with ProcessPoolExecutor(
            jobs, mp_context=get_context("spawn"), initializer=_one_thread
        ) as pool:
            yield pool
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _one_thread() -> None:
    cv2.setNumThreads(1)
