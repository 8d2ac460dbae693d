"""Process of a measure's function: what the function does to its process does not reach this one.

Each function has one process, which lives until `end_functions` or the end of this process.
"""

import os
import sys
import threading
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TypeVar

import msgspec

from validation.errors import InputError
from validation.peers.messages import REPLY_BYTES, Description, Reply, Request
from validation.peers.process import ForeignProcess
from validation.peers.view_input import Seen

_MAIN = "from validation.peers.serve import main; main()"
M = TypeVar("M", Description, Reply)


class FunctionProcess:
    """Process that has imported a function and answers requests."""

    def __init__(self, target: str, *, limit_s: float) -> None:
        """Start the process and wait until it has imported `package.module:function`.

        Raises:
            InputError: the import fails, ends the process or takes longer.
        """
        where = f"--measure {target}"
        child_reads, requests = os.pipe()
        replies, child_writes = os.pipe()
        self._requests, self._replies = (
            Connection(requests, readable=False),
            Connection(replies, writable=False),
        )
        path = os.pathsep.join(dict.fromkeys(word for word in sys.path if word))
        program = [sys.executable, "-P", "-c", _MAIN, str(child_reads), str(child_writes), target]
        try:
            self._process = ForeignProcess(
                ["env", f"PYTHONPATH={path}", *program],
                pass_fds=(child_reads, child_writes),
                where=where,
            )
        finally:
            os.close(child_reads)
            os.close(child_writes)
        self.description = self._receive(Description, limit_s=limit_s)
        if self.description.error:
            self.close()
            raise InputError(self.description.error)

    def measure(self, seen: Seen, *, where: str, limit_s: float) -> dict[str, list[float]]:
        """Columns of the function on one view.

        Raises:
            InputError: the function fails, ends its process, takes longer or prints too much.
        """
        try:
            self._requests.send_bytes(msgspec.msgpack.encode(Request.of(seen, where=where)))
        except OSError:
            raise self._process.failed(self.close()) from None
        reply = self._receive(Reply, limit_s=limit_s)
        if reply.error:
            raise InputError(reply.error)
        return reply.columns

    def _receive(self, kind: type[M], *, limit_s: float) -> M:
        try:
            answered = self._replies.poll(limit_s)
            packed = self._replies.recv_bytes(REPLY_BYTES) if answered else None
            reply = msgspec.msgpack.decode(packed, type=kind) if packed is not None else None
        except (EOFError, OSError, msgspec.DecodeError):
            raise self._process.failed(self.close()) from None
        except BaseException:
            self.close()
            raise
        if reply is None:
            self.close()
            raise self._process.timed_out(limit_s)
        return reply

    def close(self) -> int:
        """End the process; its exit status."""
        self._requests.close()
        self._replies.close()
        return self._process.close()

    @property
    def closed(self) -> bool:
        """Whether the process has been ended."""
        return self._requests.closed


_RUNNING: dict[tuple[str, Path], FunctionProcess] = {}
_ONE_AT_A_TIME = threading.RLock()


def _running(target: str, *, limit_s: float) -> FunctionProcess:
    key = target, Path.cwd()
    process = _RUNNING.get(key)
    if process is None or process.closed:
        process = _RUNNING[key] = FunctionProcess(target, limit_s=limit_s)
    return process


def describe_function(target: str, *, limit_s: float) -> Description:
    """Declared traits and source file of a function.

    Raises:
        InputError: as FunctionProcess.
    """
    with _ONE_AT_A_TIME:
        return _running(target, limit_s=limit_s).description


def call_function(target: str, seen: Seen, *, where: str, limit_s: float) -> dict[str, list[float]]:
    """Columns of a function on one view, one number a rock in the rising order of the labels.

    Raises:
        InputError: as `FunctionProcess.measure`.
    """
    with _ONE_AT_A_TIME:
        return _running(target, limit_s=limit_s).measure(seen, where=where, limit_s=limit_s)


def end_functions() -> None:
    """End the processes of all functions; the next call imports its function anew."""
    with _ONE_AT_A_TIME:
        for process in _RUNNING.values():
            if not process.closed:
                process.close()
        _RUNNING.clear()
