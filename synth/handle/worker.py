"""Worker process: one call of a function, asked for on stdin and answered on stdout.

The process is fresh, so it has no OpenGL yet, and ends after its call. It never imports the
caller's `__main__`: it serves scripts without a guard, `python -c`, stdin and notebooks alike.
"""

import os
import pickle
import sys
import traceback
from typing import Any

from synth.dataset.workers import begin_worker
from synth.errors import MissingBackendError, RenderError, ReplayError, SpecError


def main() -> None:
    """Answer the call on stdin.

    The request is a pickled pair: registered sensors and rock families, and the pickled function
    with its arguments. The reply is a pickled pair: a value and None, or None and an error.
    """
    reply = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what libraries print is no part of the reply
    registered, call = pickle.loads(sys.stdin.buffer.read())
    with reply:
        pickle.dump(_answer(registered, call), reply)


def _answer(registered: Any, call: bytes) -> tuple[Any, Exception | None]:
    try:
        begin_worker(registered)
        function, arguments = pickle.loads(call)
        return function(*arguments), None
    except (SpecError, MissingBackendError, ReplayError, OSError, MemoryError) as error:
        return None, error
    except Exception:
        return None, RenderError(f"a worker process failed:\n{traceback.format_exc()}")
