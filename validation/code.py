"""What code a unit's result comes from: the sources that make, measure and match, and versions."""

import hashlib
import platform
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files
from importlib.resources.abc import Traversable

_PACKAGES = ("rockshape", "synth")
_OWN = (
    "units.py",
    "views.py",
    "work.py",
    "records.py",
    "match.py",
    "truth.py",
    "pictures.py",
    "portraits.py",
    "store.py",
    "measures",
    "segments",
    "design/places.py",
    "design/unit.py",
)
_DISTRIBUTIONS = (
    "arcade-pyrender",
    "embreex",
    "numpy",
    "opencv-python-headless",
    "pandas",
    "pillow",
    "scikit-image",
    "scipy",
    "trimesh",
)


def _add(digest: "hashlib._Hash", path: Traversable, name: str) -> None:
    if path.is_dir():
        for child in sorted(path.iterdir(), key=lambda each: each.name):
            if child.name != "__pycache__":
                _add(digest, child, f"{name}/{child.name}")
    elif path.is_file():
        digest.update(name.encode() + b"\0" + path.read_bytes())


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "none"


@cache
def code_digest() -> str:
    """Return a hash of the sources and of the versions that can move a unit's result.

    Scores, gates and report do not count: they are made anew from the results every time.
    """
    digest = hashlib.sha256(platform.python_version().encode())
    for package in _PACKAGES:
        _add(digest, files(package), package)
    for name in _OWN:
        _add(digest, files("validation") / name, f"validation/{name}")
    for name in _DISTRIBUTIONS:
        digest.update(f"{name} {_version(name)}\n".encode())
    return digest.hexdigest()
