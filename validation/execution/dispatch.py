"""Units onto an executor and their results into the store, each as soon as it is done."""

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait

import cv2

from validation.errors import WorkerError
from validation.execution.fingerprint import code_digest
from validation.execution.store import UnitStore, code_of, pack
from validation.execution.units import AnyUnit, describe
from validation.execution.work import run_unit

WINDOW = 1024  # units submitted at a time: neither futures nor results pile up
_ONE_AT_A_TIME = threading.Lock()  # OpenGL belongs to one thread of a process

OnDone = Callable[[AnyUnit], None]


def run_packed(unit: AnyUnit) -> bytes:
    """Packed result of a unit, run in a worker with one thread.

    Raises:
        WorkerError: foreign code in the unit, a method of a plug-in say, leaves by SystemExit.
    """
    with _ONE_AT_A_TIME:
        cv2.setNumThreads(1)
        try:
            return pack(run_unit(unit))
        except Exception:
            raise
        except BaseException as error:
            kind = type(error).__name__
            raise WorkerError(f"{describe(unit)}: expected a result, found {kind}") from None


def _checked(packed: bytes, unit: AnyUnit) -> bytes:
    if code_of(packed) != code_digest():
        raise WorkerError(
            f"{describe(unit)}: expected workers with the code and versions of this process, "
            "found others"
        )
    return packed


def dispatch(
    work: Sequence[tuple[str, AnyUnit]], executor: Executor, store: UnitStore, on_done: OnDone
) -> None:
    """Run keyed units and store what comes back, in whatever order it comes.

    Raises:
        WorkerError: a worker has other code than this process; or it died again and again.
    """
    waiting = list(reversed(work))
    running: dict[Future[bytes], tuple[str, AnyUnit]] = {}
    try:
        while waiting or running:
            while waiting and len(running) < WINDOW:
                key, unit = waiting.pop()
                running[executor.submit(run_packed, unit)] = (key, unit)
            done, _ = wait(running, return_when=FIRST_COMPLETED)
            for future in done:
                key, unit = running.pop(future)
                store.put(key, _checked(future.result(), unit))
                on_done(unit)
    except BaseException:
        for future in running:
            future.cancel()
        raise
