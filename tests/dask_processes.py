"""A real Dask cluster on this machine: a scheduler and two workers, each a process of its own."""

import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

LOCAL = "127.0.0.1"
Process = subprocess.Popen[str]


@contextmanager
def dask_processes(folder: Path) -> Iterator[tuple[str, list[Process]]]:
    """Address of a scheduler, and its two workers, which keep their files in a folder."""
    with _process("scheduler", "--host", LOCAL, "--port", "0", "--no-dashboard") as scheduler:
        address = _wait_for(scheduler, rf"tcp://{LOCAL}:\d+")
        with _workers(address, folder) as workers:
            yield address, workers


@contextmanager
def _process(*words: str) -> Iterator[Process]:
    with subprocess.Popen(
        [sys.executable, "-m", "distributed.cli.dask_" + words[0], *words[1:]],
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
    ) as process:
        try:
            yield process
        finally:
            process.kill()


def _wait_for(process: Process, pattern: str) -> str:
    assert process.stderr is not None
    for line in process.stderr:
        found = re.search(pattern, line)
        if found:
            return found[0]
    raise AssertionError(f"{pattern}: the process ended before it said so")


@contextmanager
def _workers(address: str, folder: Path) -> Iterator[list[Process]]:
    one = ("worker", address, "--no-nanny", "--no-dashboard", "--nthreads", "1")
    options = (*one, "--host", LOCAL, "--local-directory", str(folder))
    with _process(*options) as first, _process(*options) as second:
        for worker in (first, second):
            _wait_for(worker, r"Registered to")
        yield [first, second]
