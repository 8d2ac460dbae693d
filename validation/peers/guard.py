"""Guard of a foreign process: whatever the process started ends with it, or with the run.

Run as a script with the number of a file descriptor, the lifeline, and a command. The guard ends
with the command's exit status, 128 + N for signal N and 127 for no such program. When the lifeline
is closed at its other end, which the death of the run does too, or the guard is told to end by
SIGHUP, SIGINT or SIGTERM, the guard kills the command. In any case it kills all descendants of the
command, also those that left its session: on Linux they become children of the guard
(PR_SET_CHILD_SUBREAPER).
"""

import ctypes
import os
import select
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

PR_SET_CHILD_SUBREAPER = 36
NO_SUCH_PROGRAM = 127
SIGNAL_BASE = 128
_ENDING = (signal.SIGHUP, signal.SIGINT, signal.SIGTERM)
_PAUSE_S = 0.005


def guard(lifeline: int, argv: list[str]) -> int:
    """Exit status of a command that is killed with all its descendants when the lifeline closes."""
    os.set_inheritable(lifeline, False)
    woken, wakes = os.pipe()
    os.set_blocking(wakes, False)
    for number in (signal.SIGCHLD, *_ENDING):
        signal.signal(number, lambda *_: None)
    signal.set_wakeup_fd(wakes, warn_on_full_buffer=False)
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    try:
        child = os.posix_spawnp(
            argv[0],
            argv,
            os.environ,
            setsid=True,
            setsigdef=(signal.SIGPIPE, signal.SIGXFSZ, signal.SIGCHLD),
        )
    except OSError as error:
        print(f"{argv[0]}: {error.strerror}", file=sys.stderr)
        return NO_SUCH_PROGRAM
    status = _wait(child, lifeline, woken)
    _kill_descendants(child)
    return status


def _wait(child: int, lifeline: int, woken: int) -> int:
    """Exit status of the child; 128 + N where signal N or, as SIGKILL, the lifeline ends it."""
    while True:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            code = os.waitstatus_to_exitcode(status)
            return code if code >= 0 else SIGNAL_BASE - code
        ready, _, _ = select.select([lifeline, woken], [], [])
        if lifeline in ready:
            return SIGNAL_BASE + signal.SIGKILL
        for number in os.read(woken, 4096):
            if number in _ENDING:
                return SIGNAL_BASE + number


def _kill_descendants(group: int) -> None:
    """Kill a process group and every descendant of this process, until none is left."""
    while True:
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(group, signal.SIGKILL)
        for process in _descendants():
            with suppress(ProcessLookupError, PermissionError):
                os.kill(process, signal.SIGKILL)
        try:
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        except ChildProcessError:
            return
        time.sleep(_PAUSE_S)


def _descendants() -> Iterator[int]:
    """Processes that descend from this one, as /proc lists them; none where there is no /proc."""
    children: dict[int, list[int]] = {}
    for entry in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError, ValueError):
            parent = int(entry.read_text(errors="replace").rpartition(")")[2].split()[1])
            children.setdefault(parent, []).append(int(entry.parent.name))
    waiting = [os.getpid()]
    while waiting:
        for process in children.get(waiting.pop(), ()):
            waiting.append(process)
            yield process


if __name__ == "__main__":
    sys.exit(guard(int(sys.argv[1]), sys.argv[2:]))
