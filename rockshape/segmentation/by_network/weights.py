"""Weights of the finder: those of the package, or of a folder in their place."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from importlib.resources import files
from pathlib import Path

NETWORK = "network.onnx"
LIKELIHOOD = "likelihood.json"
_FOLDER: ContextVar[Path | None] = ContextVar("folder of the finder's weights", default=None)


@contextmanager
def weights_from(folder: Path) -> Iterator[None]:
    """Let the finder use the network and the likelihood of a folder."""
    token = _FOLDER.set(folder.resolve())
    try:
        yield
    finally:
        _FOLDER.reset(token)


def read_weights(name: str) -> bytes:
    """Content of `network.onnx` or `likelihood.json`."""
    return _read(_FOLDER.get(), name)


@cache
def _read(folder: Path | None, name: str) -> bytes:
    return (files(__package__) / name if folder is None else folder / name).read_bytes()
