"""Folders and locks of the plug-in: one for the session, and one kept for the next session."""

import os
import shutil
import tempfile
import time
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

SHARED = "rockshape_shared"  # key of an xdist worker's input
KEPT_S = 7 * 24 * 3600  # since its last use
_FOLDER = pytest.StashKey[Path]()


def shared_folder(config: pytest.Config) -> Path:
    """Temporary folder of the session, the same in all of its xdist workers."""
    if _FOLDER not in config.stash:
        given = getattr(config, "workerinput", {}).get(SHARED)
        config.stash[_FOLDER] = Path(given or tempfile.mkdtemp(prefix="rockshape-pytest-"))
    return config.stash[_FOLDER]


def remove_shared_folder(config: pytest.Config) -> None:
    """Remove the session's folder, but from no xdist worker."""
    folder = config.stash.get(_FOLDER, None)
    if folder is not None and not hasattr(config, "workerinput"):
        shutil.rmtree(folder, ignore_errors=True)


def kept_folder(config: pytest.Config) -> Path:
    """Folder within pytest's cache, or the session's folder where caching is off."""
    cache = getattr(config, "cache", None)
    if cache is None or config.getoption("rockshape_no_cache"):
        return shared_folder(config)
    return Path(cache.mkdir("rockshape"))


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold a lock file that no other process holds; a process that dies lets go of it."""
    import fcntl  # noqa: PLC0415 (POSIX alone)

    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def keep_recent(folder: Path, used: Collection[Path], *, pattern: str) -> None:
    """Mark files as used now, and remove those of a pattern that were not used for a week."""
    for path in used:
        os.utime(path)
    oldest = time.time() - KEPT_S
    for path in folder.glob(pattern):
        if path.stat().st_mtime < oldest:
            path.unlink(missing_ok=True)
