"""Where units run: processes of this machine, or a Dask cluster. Both are executors."""

import os
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import (
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
)
from concurrent.futures.process import BrokenProcessPool
from contextlib import AbstractContextManager, contextmanager
from multiprocessing import parent_process
from multiprocessing.context import SpawnContext, SpawnProcess
from types import ModuleType
from typing import Any

from rockshape.errors import InputError, MissingPackageError, WorkerError

TRIES = 3  # of a unit whose worker dies; a Dask scheduler has the same by default
CONNECT_S = 10
BLAS_THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")
_STARTING = threading.Lock()  # one process at a time hides the main module


def default_jobs() -> int:
    """Number of processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _die_with_parent() -> None:
    """End this process when the one that began it has gone, however it went."""
    parent = parent_process()

    def watch() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


class _WorkerProcess(SpawnProcess):
    """Process that imports our modules alone, and not the script or notebook that began it.

    A script without `if __name__ == "__main__"` would otherwise begin itself again in each process.
    """

    @staticmethod
    def _Popen(process_obj: Any) -> Any:  # noqa: N802 - multiprocessing's name
        with _STARTING:
            script = sys.modules["__main__"]
            sys.modules["__main__"] = ModuleType("__main__")
            try:
                return SpawnProcess._Popen(process_obj)
            finally:
                sys.modules["__main__"] = script


class _WorkerContext(SpawnContext):
    """Context of fresh processes that do not import the main module."""

    Process = _WorkerProcess


class LocalExecutor(Executor):
    """Fresh processes that may render; each is a pool by itself.

    A process that is killed takes nothing with it but the call it was at, which is tried again in
    another.
    """

    def __init__(self, jobs: int) -> None:
        """Make room for so many processes; each starts with its first call."""
        self._threads = ThreadPoolExecutor(jobs, thread_name_prefix="worker")
        self._own = threading.local()
        self._pools: list[ProcessPoolExecutor] = []
        self._killed = False

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        """Call a function in one of the processes."""
        return self._threads.submit(self._call, fn, *args, **kwargs)

    def _call(self, fn: Callable[..., Any], *args: Any, **kwargs: Any) -> Any:
        for _ in range(TRIES):
            if self._killed:
                raise CancelledError
            pool = getattr(self._own, "pool", None)
            if pool is None:
                pool = ProcessPoolExecutor(1, _WorkerContext(), initializer=_die_with_parent)
                self._own.pool = pool
                self._pools.append(pool)
            try:
                return pool.submit(fn, *args, **kwargs).result()
            except BrokenProcessPool:
                self._own.pool = None
        raise WorkerError(f"--jobs: {TRIES} processes died at the same unit: out of memory?")

    def kill(self) -> None:
        """End the processes at once, whatever they are at."""
        self._killed = True
        self._threads.shutdown(wait=False, cancel_futures=True)
        for pool in list(self._pools):
            for process in list((pool._processes or {}).values()):
                process.kill()

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the processes after the calls they are at."""
        self._threads.shutdown(wait=wait, cancel_futures=cancel_futures)
        for pool in self._pools:
            pool.shutdown(wait=wait, cancel_futures=cancel_futures)


@contextmanager
def _one_blas_thread() -> Iterator[None]:
    """Let processes begun within start numpy with one thread, unless the user says otherwise."""
    added = {name: "1" for name in BLAS_THREADS if name not in os.environ}
    os.environ.update(added)
    try:
        yield
    finally:
        for name in added:
            del os.environ[name]


def local(jobs: int) -> AbstractContextManager[Executor]:
    """Processes of this machine, started as the context is entered.

    Raises:
        InputError: jobs is less than one, before anything is started or written.
    """
    if not isinstance(jobs, int) or jobs < 1:
        raise InputError(f"jobs (--jobs): expected 1 or more, found {jobs!r}")
    return _local(jobs)


@contextmanager
def _local(jobs: int) -> Iterator[Executor]:
    with _one_blas_thread(), LocalExecutor(jobs) as executor:
        try:
            yield executor
        except BaseException:
            executor.kill()
            raise


@contextmanager
def cluster(address: str) -> Iterator[Executor]:
    """The workers of a Dask scheduler, through `Client.get_executor`.

    Raises:
        MissingPackageError: dask.distributed is not installed.
        InputError: no scheduler answers at the address, or it has no worker.
        WorkerError: a unit killed several workers.
    """
    try:
        from distributed import Client  # noqa: PLC0415 (an extra, and slow to import)
        from distributed.scheduler import KilledWorker  # noqa: PLC0415
    except ImportError as error:
        raise MissingPackageError(
            "--scheduler: expected the package distributed, found none: "
            "install rockshape with the extra cluster"
        ) from error
    try:
        client = Client(address, timeout=CONNECT_S, set_as_default=False)
    except (OSError, ValueError) as error:
        raise InputError(
            f"--scheduler: expected the address of a Dask scheduler, as tcp://host:8786, "
            f"found none that answers at {address}"
        ) from error
    with client:
        try:
            client.wait_for_workers(1, timeout=CONNECT_S)
        except TimeoutError as error:
            raise InputError(f"--scheduler: expected a worker at {address}, found none") from error
        executor = client.get_executor(pure=False)
        try:
            with executor:
                yield executor
        except KilledWorker as error:
            raise WorkerError(f"--scheduler: {error}") from error
