"""Reading and writing a file whole, and saying in one line what is wrong with it."""

import os
import tempfile
from pathlib import Path
from typing import IO

from rockshape.errors import InputError


def read_bytes(path: Path, *, what: str) -> bytes:
    """Everything in a file. Raises InputError where it is missing, a folder, empty or locked."""
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        raise InputError(f"{path}: expected {what}, found no such file") from None
    except IsADirectoryError:
        raise InputError(f"{path}: expected {what}, found a directory") from None
    except OSError as error:
        raise InputError(f"{path}: expected {what}, found {error.strerror}") from None
    if not data:
        raise InputError(f"{path}: expected {what}, found an empty file")
    return data


def check_writable(path: Path, *, endings: tuple[str, ...]) -> None:
    """Raises InputError where a file cannot be written, before any work is done for it.

    endings are those the path's name may have, `.png` for instance.
    """
    if path.suffix.lower() not in endings:
        raise InputError(f"{path}: expected a name ending in {', '.join(endings)}")
    if path.is_dir():
        raise InputError(f"{path}: expected a file to write, found a directory")
    folder = path.parent
    if not folder.is_dir():
        raise InputError(f"{path}: expected an existing folder to write in, found no {folder}")
    if not os.access(folder, os.W_OK):
        raise InputError(f"{path}: expected a folder to write in, found {folder} not writable")


def write_bytes(path: Path, data: bytes) -> None:
    """Write a file whole or not at all: first beside it, then renamed.

    Raises InputError where the system refuses: a full disk, a folder that takes no files.
    """
    check_writable(path, endings=(path.suffix.lower(),))
    try:
        with tempfile.NamedTemporaryFile(dir=path.parent, prefix=".", delete=False) as draft:
            _finish(path, draft, data)
    except OSError as error:
        raise InputError(f"{path}: expected a place to write, found {error.strerror}") from None


def _finish(path: Path, draft: IO[bytes], data: bytes) -> None:
    """Fill a draft and give it the path's name, or remove it."""
    try:
        draft.write(data)
        draft.close()
        Path(draft.name).chmod(0o666 & ~_umask())
        Path(draft.name).replace(path)
    except BaseException:
        Path(draft.name).unlink(missing_ok=True)
        raise


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
