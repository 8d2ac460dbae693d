"""Foreign process: a command under a guard, with limits on its time and its output."""

import os
import subprocess
import sys
import threading
from collections.abc import Sequence
from contextlib import suppress
from typing import IO

from validation.errors import InputError
from validation.peers import guard

LIMIT_S = 600.0
MAX_OUTPUT_BYTES = 16 * 2**20  # on standard output and standard error together
_TAIL_BYTES = 4096
_END_S = 30.0  # in which a guard that has lost its lifeline ends


class ForeignProcess:
    """Command that ends, with all that it starts, when it is closed or this process is gone.

    Its standard input is empty. What it prints is not shown; the last line on standard error is
    kept for messages.
    """

    def __init__(self, argv: Sequence[str], *, pass_fds: Sequence[int] = (), where: str) -> None:
        """Start the command; `pass_fds` are file descriptors that it inherits."""
        self._where = where
        self._written = 0
        self._tail = b""
        lifeline, self._lifeline = os.pipe()
        try:
            self._process = subprocess.Popen(
                [sys.executable, "-I", "-S", guard.__file__, str(lifeline), *argv],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                pass_fds=(lifeline, *pass_fds),
                start_new_session=True,
            )
        except BaseException:
            os.close(self._lifeline)
            raise
        finally:
            os.close(lifeline)
        self._pumps = [
            threading.Thread(target=self._pump, args=(stream, keep), daemon=True)
            for stream, keep in ((self._process.stdout, False), (self._process.stderr, True))
        ]
        for pump in self._pumps:
            pump.start()

    def _pump(self, stream: IO[bytes], keep: bool) -> None:
        """Read a stream to its end, and end the command when it has written too much."""
        while chunk := os.read(stream.fileno(), 2**16):
            self._written += len(chunk)
            if keep:
                self._tail = (self._tail + chunk)[-_TAIL_BYTES:]
            if self._written > MAX_OUTPUT_BYTES:
                self._cut()
        stream.close()

    def _cut(self) -> None:
        lifeline, self._lifeline = self._lifeline, -1
        if lifeline >= 0:
            with suppress(OSError):
                os.close(lifeline)

    def close(self) -> int:
        """End the command and all that it started; its exit status."""
        self._cut()
        status = self._process.wait(_END_S)
        for pump in self._pumps:
            pump.join(_END_S)
        return status

    def finish(self, limit_s: float) -> None:
        """Wait until the command ends with status 0.

        Raises:
            InputError: it fails, takes longer, or writes too much.
        """
        try:
            status = self._process.wait(limit_s)
        except subprocess.TimeoutExpired:
            raise self.timed_out(limit_s) from None
        finally:
            self.close()
        if status != 0 or self._written > MAX_OUTPUT_BYTES:
            raise self.failed(status)

    def timed_out(self, limit_s: float) -> InputError:
        """Error of a command that does not end in time."""
        return InputError(f"{self._where}: expected an end within {limit_s:g} s, found none")

    def failed(self, status: int) -> InputError:
        """Error of a command that ended when it should not, or wrote too much."""
        if self._written > MAX_OUTPUT_BYTES:
            return InputError(
                f"{self._where}: expected at most {MAX_OUTPUT_BYTES} bytes of output, found more"
            )
        said = self._tail.decode(errors="replace").strip().splitlines() or ["nothing on stderr"]
        return InputError(f"{self._where}: ended with {status}: {said[-1]}")
