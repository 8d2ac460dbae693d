"""Images of a batch: files, folders, patterns and lists of them."""

import glob
from collections.abc import Iterator, Sequence
from pathlib import Path

from rockshape.errors import InputError
from rockshape.io.registry import IMAGES

LIST_SUFFIX = ".txt"


def is_batch(given: Sequence[str]) -> bool:
    """Whether what was given stands for other than one image."""
    if len(given) != 1:
        return True
    (one,) = given
    return Path(one).is_dir() or Path(one).suffix == LIST_SUFFIX or _is_pattern(one)


def images_of(given: Sequence[str]) -> list[Path]:
    """Image files in the order given, each once; those of a folder or a pattern by name.

    Raises: InputError for a file that is missing, and a folder, pattern or list without images.
    """
    found = dict.fromkeys(path for each in given for path in _images(each))
    return list(found)


def _images(given: str) -> Iterator[Path]:
    path = Path(given)
    if path.is_dir():
        suffixes = {suffix for each in IMAGES.formats for suffix in each.suffixes}
        files = [each for each in sorted(path.iterdir()) if each.suffix.lower() in suffixes]
        yield from _some(files, f"{given}: expected a folder with images, found none")
    elif path.suffix == LIST_SUFFIX and path.is_file():
        lines = [line.strip() for line in path.read_text(encoding="utf-8").splitlines()]
        files = [path.parent / line for line in lines if line]
        yield from _some(files, f"{given}: expected a list of images, found an empty one")
    elif _is_pattern(given):
        files = [Path(each) for each in sorted(glob.glob(given, recursive=True))]  # noqa: PTH207 - also absolute
        yield from _some(files, f"{given}: expected a pattern of images, found no such file")
    else:
        yield path


def _is_pattern(given: str) -> bool:
    return not Path(given).exists() and glob.has_magic(given)


def _some(files: list[Path], complaint: str) -> list[Path]:
    if not files:
        raise InputError(complaint)
    return files
