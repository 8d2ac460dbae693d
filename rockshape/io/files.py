"""Whole-file reading and atomic writing, with one line for what is wrong."""

import os
import stat
import tempfile
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from math import prod
from pathlib import Path
from typing import IO

from rockshape.errors import InputError

HEAD_BYTES = 2**16  # what content sniffing is shown
MAX_PIXELS = 2**27  # 134 million: 12,000 x 9,000 and a little more
MAX_PIXEL_BYTES = 8  # four channels of 16 bits, or a double
MAX_PIXEL_VALUES = 4  # of labels and range: x, y, z and a confidence
SMALL_PIXELS = 2**18  # what is never too many; another shape is then told by the reader


@dataclass(frozen=True, eq=False)
class InputFile:
    """File to read; its bytes are read when first asked for."""

    path: Path
    expected: str = "a file"  # what it should be, for the messages
    max_pixels: int = MAX_PIXELS  # what may be decoded
    image_shape: tuple[int, int] | None = None  # of the image that it belongs to

    @cached_property
    def head(self) -> bytes:
        """First bytes. Raises: InputError where the file is missing, a folder, empty or locked."""
        return self._read(HEAD_BYTES)

    @cached_property
    def data(self) -> bytes:
        """All bytes. Raises: InputError as `head` does."""
        return self._read(-1)

    def check_shape(self, shape: Sequence[int], *, item_bytes: int = 1) -> None:
        """Check the shape that a file declares, before its values are decoded.

        shape is (rows, cols, …), or (n, rows, cols) of a stack of masks. Raises: InputError for
        more pixels than `max_pixels`, more than eight bytes for each of those, or far more values
        than the image has pixels.
        """
        found = " x ".join(map(str, shape))
        stacked = tuple(shape[-2:]) == self.image_shape
        pixels = prod(shape[1:] if stacked else shape[:2])
        if pixels > self.max_pixels:
            raise InputError(
                f"{self.path}: expected at most {self.max_pixels} pixels (--max-pixels), "
                f"found {found}"
            )
        if prod(shape) * item_bytes > MAX_PIXEL_BYTES * self.max_pixels:
            raise InputError(
                f"{self.path}: expected at most {MAX_PIXEL_BYTES * self.max_pixels} bytes "
                f"({MAX_PIXEL_BYTES} x --max-pixels), found {found} of {item_bytes}"
            )
        if self.image_shape is not None and not stacked:
            most = MAX_PIXEL_VALUES * max(prod(self.image_shape), SMALL_PIXELS)
            if prod(shape) > most:
                raise InputError(
                    f"{self.path}: expected {self.image_shape} as the image has, "
                    f"found {tuple(shape)}"
                )

    def _read(self, size: int) -> bytes:
        try:
            if not stat.S_ISREG(self.path.stat().st_mode) and not self.path.is_dir():
                raise self.refusal("no regular file")  # a pipe or a device can have no end
            with self.path.open("rb") as stream:
                data = stream.read(size)
        except FileNotFoundError:
            raise self.refusal("no such file") from None
        except IsADirectoryError:
            raise self.refusal("a directory") from None
        except OSError as error:
            raise self.refusal(error.strerror or "an unreadable file") from None
        if not data:
            raise self.refusal("an empty file")
        return data

    def refusal(self, found: str) -> InputError:
        """Error that names the file, what was expected and what was found."""
        return InputError(f"{self.path}: expected {self.expected}, found {found}")


def check_writable(path: Path, *, suffixes: Collection[str]) -> None:
    """Raises: InputError where a file cannot be written, before any work is done for it.

    suffixes are those that the path's name may have, `.png` for instance.
    """
    suffix = path.suffix.lower()
    if suffix not in suffixes:
        raise InputError(
            f"{path}: expected a name ending in {', '.join(suffixes)}, "
            f"found {suffix or 'no suffix'}"
        )
    if path.is_dir():
        raise InputError(f"{path}: expected a file to write, found a directory")
    folder = path.parent
    if not folder.is_dir():
        raise InputError(f"{path}: expected an existing folder to write in, found no {folder}")
    if not os.access(folder, os.W_OK):
        raise InputError(f"{path}: expected a folder to write in, found {folder} not writable")


def write_bytes(path: Path, data: bytes) -> None:
    """Write a file whole or not at all: first beside it, then renamed.

    Raises: InputError where the system refuses: a full disk, a folder that takes no files.
    """
    with draft_of(path) as draft:
        draft.write(data)


@contextmanager
def draft_of(path: Path) -> Iterator[IO[bytes]]:
    """File beside a path that gets the path's name once it is filled, and is removed otherwise.

    Raises: InputError where the system refuses: a full disk, a folder that takes no files.
    """
    check_writable(path, suffixes=(path.suffix.lower(),))
    try:
        with tempfile.NamedTemporaryFile(dir=path.parent, prefix=".", delete=False) as draft:
            try:
                yield draft
                draft.close()
                Path(draft.name).chmod(0o666 & ~_umask())
                Path(draft.name).replace(path)
            except BaseException:
                Path(draft.name).unlink(missing_ok=True)
                raise
    except OSError as error:
        raise InputError(f"{path}: expected a place to write, found {error.strerror}") from None


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
