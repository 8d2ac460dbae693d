"""Text files of bounded size."""

import errno
import os
import stat
from pathlib import Path

MAX_BYTES = 2**28


def read_text(path: Path) -> str:
    """Text of a file in UTF-8, with or without a byte order mark.

    Raises:
        OSError: there is no such file, it is none (a device or a pipe can have no end), or it has
            more than 256 MiB.
        UnicodeDecodeError: it is no text.
    """
    found = path.stat()
    if not stat.S_ISREG(found.st_mode):
        number = errno.EISDIR if stat.S_ISDIR(found.st_mode) else errno.EINVAL
        said = os.strerror(errno.EISDIR) if number == errno.EISDIR else "No regular file"
        raise OSError(number, said, str(path))
    if found.st_size > MAX_BYTES:
        raise OSError(errno.EFBIG, os.strerror(errno.EFBIG), str(path))
    return path.read_text(encoding="utf-8-sig")
