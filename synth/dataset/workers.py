"""Worker processes for rendering, each limited to one thread: the processes are the parallelism."""

import os
import threading
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context, parent_process
from multiprocessing.queues import SimpleQueue

import cv2

from synth.progress import report_progress_to
from synth.spec.rocks import FAMILIES
from synth.spec.sensor import SENSORS

# OpenBLAS, MKL, OpenMP and Mesa's llvmpipe read these when they are loaded.
ONE_THREAD = {
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "LP_NUM_THREADS": "1",
}


Registrations = tuple[bytes, bytes]
Reports = SimpleQueue[str | None]


def registrations() -> Registrations:
    """Registered sensors and rock families, for worker processes.

    Raises:
        SpecError: a registered record is in no module that the processes can import.
    """
    return SENSORS.dump(), FAMILIES.dump()


@contextmanager
def worker_pool(jobs: int, *, reports: Reports | None = None) -> Iterator[ProcessPoolExecutor]:
    """Pool of so many processes that have no OpenGL yet.

    A process is spawned when work is submitted, with the environment of that moment, so the
    environment holds the limits as long as the pool is open. With one thread sums have one order
    too: the bytes do not depend on the number of processors. The processes know the sensors and
    rock families that are registered here, and put their progress into `reports`.

    Raises:
        SpecError: a registered record is in no module that the processes can import.
    """
    before = {name: os.environ.get(name) for name in ONE_THREAD}
    os.environ.update(ONE_THREAD)
    try:
        with ProcessPoolExecutor(
            jobs,
            mp_context=get_context("spawn"),
            initializer=begin_worker,
            initargs=(registrations(), reports),
        ) as pool:
            yield pool
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def begin_worker(registered: Registrations, reports: Reports | None = None) -> None:
    """Limit this process to one thread and take over the parent's registered records.

    What is reported of progress goes into `reports`.
    """
    _Reports.queue = reports
    cv2.setNumThreads(1)
    SENSORS.load(registered[0])
    FAMILIES.load(registered[1])
    threading.Thread(target=_end_with_parent, daemon=True).start()


class _Reports:
    """Queue of this process for reports of progress."""

    queue: Reports | None = None


def begin_scene(name: str) -> None:
    """Report this process's progress under a scene's name from now on."""
    queue = _Reports.queue
    report_progress_to(None if queue is None else lambda text: queue.put(f"scene {name}: {text}"))


def _end_with_parent() -> None:
    """End this process when the one that gives it work is gone: it would wait for ever."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
