"""Calls of functions in fresh worker processes."""

import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, TypeVarTuple, cast

from synth.dataset.workers import ONE_THREAD, registrations
from synth.errors import RenderError

T = TypeVar("T")
Ts = TypeVarTuple("Ts")

_COMMAND = "from synth.handle.worker import main; main()"


def call_in_worker(function: Callable[[*Ts], T], *arguments: *Ts, timeout_s: float | None) -> T:
    """Value of a function called in a process of its own, which ends with the call.

    The function must be importable, arguments and value picklable. The process has one thread, as
    those that write datasets have, and the module search path of this one. None waits for ever.

    Raises:
        SpecError, MissingBackendError: as the function raises them.
        RenderError: the process failed, died or took longer than the timeout.
    """
    return cast(T, answer(request_of(function, *arguments), timeout_s))


def request_of(function: Callable[[*Ts], Any], *arguments: *Ts) -> bytes:
    """Call of a function as a worker process is asked for it, with what is registered here.

    Raises:
        SpecError: a registered record is in no module that the processes can import.
    """
    return pickle.dumps((registrations(), pickle.dumps((function, arguments))))


def answer(request: bytes, timeout_s: float | None = None) -> Any:
    """Value of a requested call, in a fresh process. Raises: as `call_in_worker`."""
    places = [place or str(Path.cwd()) for place in sys.path]
    try:
        done = subprocess.run(
            [sys.executable, "-P", "-c", _COMMAND],  # -P: this process's search path, no more
            input=request,
            capture_output=True,
            timeout=timeout_s,
            check=False,
            env={**os.environ, **ONE_THREAD, "PYTHONPATH": os.pathsep.join(places)},
        )
    except subprocess.TimeoutExpired as error:
        raise RenderError(
            f"timeout_s: expected a worker process to finish within {timeout_s:g} s, "
            "found it still at work"
        ) from error
    if done.returncode != 0:
        said = done.stderr.decode(errors="replace").strip().splitlines()
        raise RenderError(
            f"expected a worker process to reply, found exit status {done.returncode}"
            f"{f': {said[-1]}' if said else ''}"
        )
    value, failure = pickle.loads(done.stdout)
    if failure is not None:
        raise failure
    return value
