"""Executor of another's workers: each call in a fresh process there, as those here have it.

The executor itself comes from outside, by an entry point of the group `synth.executors`: a context
manager that takes an address and yields an `Executor`, a Dask cluster's for instance.
"""

from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from concurrent.futures import wait as wait_for
from contextlib import contextmanager
from functools import partial
from importlib.metadata import entry_points
from typing import Any

from synth.errors import SpecError
from synth.handle.client import answer, request_of

GROUP = "synth.executors"
CLUSTER = "cluster"


class RemoteExecutor(Executor):
    """Calls of functions on another executor's workers.

    Each runs in a process of its own, which has one thread, no OpenGL yet, and the sensors and rock
    families that are registered here: the bytes are those of a run on this machine.
    """

    def __init__(self, executor: Executor) -> None:
        """Take over an executor, which stays open when this one is shut down."""
        self._executor = executor
        self._futures: list[Future[Any]] = []

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        """Call a function that workers can import."""
        future = self._executor.submit(answer, request_of(partial(fn, **kwargs), *args))
        self._futures.append(future)
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Wait for the calls, or give up those that have not begun."""
        if cancel_futures:
            for future in self._futures:
                future.cancel()
        if wait:
            wait_for(self._futures)


@contextmanager
def cluster_executor(address: str) -> Iterator[RemoteExecutor]:
    """Executor of the cluster at an address.

    Raises:
        SpecError: nothing that is installed knows clusters.
        Exception: as the entry point raises them, where none answers at the address.
    """
    known = tuple(entry_points(group=GROUP, name=CLUSTER))
    if not known:
        raise SpecError(f"--scheduler: expected an entry point {CLUSTER!r} of {GROUP}, found none")
    with known[0].load()(address) as executor:
        yield RemoteExecutor(executor)
