"""Lock of an output folder: one run at a time writes there.

The lock is the operating system's on the folder itself (flock), so it leaves no file behind and
ends with the process, however that ends.
"""

import errno
import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from synth.errors import SpecError

_NO_LOCKS = (errno.ENOLCK, errno.ENOTSUP, errno.EBADF, errno.EINVAL)  # of some network file systems


@contextmanager
def folder_lock(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder, which is made if it is not there.

    A folder that was made and that nothing was written to is removed again.

    Raises:
        SpecError: another run holds it, or the folder cannot be made.
    """
    made = not folder.exists()
    descriptor = _locked(folder)
    try:
        yield
    finally:
        if made:
            with suppress(OSError):  # not empty, or removed by the run itself
                folder.rmdir()
        os.close(descriptor)


def _locked(folder: Path) -> int:
    while True:
        try:
            folder.mkdir(parents=True, exist_ok=True)
            descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
        except OSError as error:
            found = error.strerror
            raise SpecError(f"{folder}: expected a folder to write to, found {found}") from error
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            if error.errno not in _NO_LOCKS:
                os.close(descriptor)
                raise SpecError(
                    f"{folder}: expected a folder that no other run writes to, found one at work"
                ) from None
        if _is_at(descriptor, folder):
            return descriptor
        os.close(descriptor)  # removed by the run that held it


def _is_at(descriptor: int, folder: Path) -> bool:
    """Whether an open folder still stands at its path."""
    try:
        return os.path.samestat(os.fstat(descriptor), folder.stat())
    except FileNotFoundError:
        return False
