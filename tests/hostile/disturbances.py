"""Ways to disturb a run: a SIGKILL, a limit to the size of files, a full disk.

Each is a context in which the run has been disturbed and can be started again; it tells what was
done and what the run did wrong.
"""

import os
import resource
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import NamedTuple

import numpy as np

SMALLEST_FILE_BYTES = 512
PAGE_BYTES = 4096  # of a filesystem in memory
ENOUGH_BYTES = 2**27


class Run(NamedTuple):
    """Run to disturb."""

    argv: list[str]
    folder: Path  # that holds its output folder
    prepare: Callable[[], None]  # puts into the output folder what is there before the run
    took_s: float  # undisturbed
    sizes: list[int]  # of the undisturbed run's files, bytes


class Disturbed(NamedTuple):
    """What was done to a run, and what it did wrong, if anything."""

    what: str
    wrong: str = ""


Way = Callable[[Run, np.random.Generator], AbstractContextManager[Disturbed]]


def start(argv: list[str], file_bytes: int | None = None) -> "subprocess.Popen[str]":
    """Start a command of rockshape, whose files may grow to so many bytes."""

    def limit() -> None:
        if file_bytes is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (file_bytes, file_bytes))

    return subprocess.Popen(
        [sys.executable, "-m", "rockshape.cli", *argv],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=limit,  # noqa: PLW1509 - no threads here
    )


@contextmanager
def killed(run: Run, rng: np.random.Generator) -> Iterator[Disturbed]:
    """A SIGKILL at a random moment."""
    run.prepare()
    seconds = rng.uniform(0.02, 1.0) * run.took_s
    process, began = start(run.argv), time.monotonic()
    while process.poll() is None and time.monotonic() - began < seconds:
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    yield Disturbed(f"killed after {seconds:.2f} s")


@contextmanager
def short_files(run: Run, rng: np.random.Generator) -> Iterator[Disturbed]:
    """A limit to the size of each file, below that of the largest (RLIMIT_FSIZE)."""
    run.prepare()
    most = int(rng.integers(SMALLEST_FILE_BYTES, max(run.sizes)))
    yield _ended(f"files of at most {most} bytes", start(run.argv, most))


@contextmanager
def full_disk(run: Run, rng: np.random.Generator) -> Iterator[Disturbed]:
    """A filesystem that holds less than the run writes, enlarged before the run is resumed."""
    needed = sum(-(-size // PAGE_BYTES) for size in run.sizes)
    pages = int(rng.integers(1, needed))
    _mount(run.folder, "-o", f"size={ENOUGH_BYTES}", "-t", "tmpfs", "tmpfs")
    try:
        run.prepare()
        disk = os.statvfs(run.folder)
        taken = disk.f_blocks - disk.f_bfree  # by old outputs, which any disk has held
        pages = max(pages, taken)
        _mount(run.folder, "-o", f"remount,size={pages * PAGE_BYTES}")
        done = _ended(f"a disk of {pages} of {needed} pages", start(run.argv))
        _mount(run.folder, "-o", f"remount,size={ENOUGH_BYTES}")
        yield done
    finally:
        subprocess.run(["umount", str(run.folder)], check=True)


def can_mount(folder: Path) -> bool:
    """Whether a filesystem in memory can be mounted here: by root, in a container that lets it."""
    if shutil.which("mount") is None:
        return False
    try:
        _mount(folder, "-o", f"size={PAGE_BYTES}", "-t", "tmpfs", "tmpfs")
    except subprocess.CalledProcessError:
        return False
    subprocess.run(["umount", str(folder)], check=True)
    return True


def _mount(folder: Path, *options: str) -> None:
    subprocess.run(["mount", *options, str(folder)], check=True, capture_output=True)


def _ended(what: str, process: "subprocess.Popen[str]") -> Disturbed:
    """A run that cannot write all: its last line alone says so, and its status is not 0."""
    said = process.communicate()[1]
    refusals = [line.startswith("rockshape: ") for line in said.splitlines()]
    told = sum(refusals) == 1 and refusals[-1] and "Traceback" not in said
    if process.returncode in (2, 3) and told:
        return Disturbed(what)
    return Disturbed(what, f"status {process.returncode}: {said[-300:]!r}")


WAYS: dict[str, Way] = {
    "SIGKILLs": killed,
    "limits to files": short_files,
    "full disks": full_disk,
}
