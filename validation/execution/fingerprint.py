"""Code fingerprint: a hash of every file that can change a unit's result, and of versions.

The three packages and all plug-ins are walked, so that a new, moved or renamed file counts without
being listed. Only what scores, draws or parses the command line is left out: the files below, and
the modules by which a kind judges and shows its experiments.
"""

import hashlib
import platform
import re
from collections.abc import Collection, Iterator
from functools import cache
from importlib.metadata import Distribution, distributions, requires
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path

from validation.suite.registry import installed_kinds

PACKAGES = ("rockshape", "synth", "validation")
# Folders and files that no worker loads; tests hold that to be so.
LEFT_OUT = frozenset(
    {
        "rockshape/cli.py",
        "rockshape/commands",
        "rockshape/report",
        "rockshape/samples",
        "synth/cli.py",
        "synth/commands",
        "validation/api.py",
        "validation/cli.py",
        "validation/commands",
        "validation/mutations",
        "validation/selfcheck",
        "validation/paper",
        "validation/pytest_plugin",
        "validation/report",
        "validation/scores",
        "validation/statistics",
        "validation/suites",
        "validation/testing",
    }
)
_NAME = re.compile(r"[A-Za-z0-9._-]+")


def loadable_files(root: Path, *, left_out: Collection[str]) -> Iterator[tuple[str, Path]]:
    """(name, path) of each file under a package's folder, in the order of the names.

    A name is the package's and the path within it, `rockshape/errors.py`; `left_out` names files
    and folders.
    """
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root.parent)
        parts = [name, *name.parents]
        loadable = path.is_file() and "__pycache__" not in name.parts
        if loadable and not any(part.as_posix() in left_out for part in parts):
            yield name.as_posix(), path


def left_out_files() -> frozenset[str]:
    """Files and folders that no worker loads, those of installed kinds included."""
    judging = (module for kind in installed_kinds().values() for module in kind.never_in_workers)
    names = [module.replace(".", "/") for module in judging]
    return LEFT_OUT | {*names, *(f"{name}.py" for name in names)}


def tree_digest(roots: Collection[Path], *, left_out: Collection[str]) -> str:
    """SHA-256 of the names and contents of the packages' files."""
    digest = hashlib.sha256()
    for root in roots:
        for name, path in loadable_files(root, left_out=left_out):
            digest.update(name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def _required() -> set[str]:
    """Names of the distributions that ours needs at run time."""
    found = (_NAME.match(text) for text in requires("rockshape") or () if "extra ==" not in text)
    return {_normal(match.group()) for match in found if match}


def _normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def _plugins(distribution: Distribution, packages: Collection[str]) -> set[str]:
    """Top-level modules by which a distribution adds to the packages, by entry points."""
    if _normal(distribution.metadata["Name"]) == "rockshape":
        return set()
    points = [p for p in distribution.entry_points if p.group.partition(".")[0] in packages]
    return {point.module.partition(".")[0] for point in points}


def _sources(module: str) -> Iterator[bytes]:
    """What a top-level module or package consists of, installed or editable."""
    spec = find_spec(module)
    if spec is None:
        return
    if spec.submodule_search_locations:
        roots = [Path(each) for each in spec.submodule_search_locations]
        yield tree_digest(roots, left_out=left_out_files()).encode()
    elif spec.origin:
        yield Path(spec.origin).read_bytes()


def _installed(packages: Collection[str]) -> Iterator[bytes]:
    """Versions of what we need, and of the plug-ins their sources too."""
    needed = _required()
    for distribution in sorted(distributions(), key=lambda each: _normal(each.metadata["Name"])):
        name, plugins = _normal(distribution.metadata["Name"]), _plugins(distribution, packages)
        if name in needed or plugins:
            yield f"{name} {distribution.version}\n".encode()
        for module in sorted(plugins):
            yield from _sources(module)


@cache
def code_digest(*packages: str) -> str:
    """Hash of the files and versions that can change what packages make; of all by default."""
    packages = packages or PACKAGES
    digest = hashlib.sha256(platform.python_version().encode())
    roots = [Path(str(files(package))) for package in packages]
    digest.update(tree_digest(roots, left_out=left_out_files()).encode())
    for part in _installed(packages):
        digest.update(part)
    return digest.hexdigest()
