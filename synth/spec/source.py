"""Source of a specification: a file, a record or plain tables, with options laid over it."""

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from synth.errors import SpecError
from synth.spec.wording import unknown_name

Table = Mapping[str, Any]


def check_names(options: Iterable[str], known: Iterable[str], *, where: str) -> None:
    """Check that every option exists.

    Raises:
        SpecError: one that does not.
    """
    names = list(known)
    for name in options:
        if name not in names:
            raise SpecError(f"{where}: {unknown_name('argument', name, names)}")


def tables_of(
    source: object,
    kind: type[msgspec.Struct],
    load: Callable[[Path], msgspec.Struct],
    *,
    where: str,
) -> Table:
    """Plain tables of a specification: a record of the kind, a path to a TOML file, tables or None.

    Raises:
        SpecError: anything else, or a file that `load` refuses.
    """
    if isinstance(source, str | Path):
        source = load(Path(source))
    if isinstance(source, kind):
        source = msgspec.to_builtins(source)
    if source is None:
        source = {}
    if not isinstance(source, Mapping):
        raise SpecError(
            f"{where}: spec: expected a path to a TOML file, a {kind.__name__} or a table, "
            f"found {type(source).__name__}"
        )
    return source


def merged(one: Table, two: Table) -> dict[str, Any]:
    """The first table with what the second says; tables within are merged, all else replaced.

    Numbers and arrays of numpy become Python's.
    """
    both = {**one, **{key: _plain(value) for key, value in two.items()}}
    for key in one.keys() & two.keys():
        if isinstance(one[key], Mapping) and isinstance(two[key], Mapping):
            both[key] = merged(one[key], two[key])
    return both


def _plain(value: object) -> object:
    if isinstance(value, Mapping):
        return {key: _plain(each) for key, each in value.items()}
    return value.tolist() if isinstance(value, np.generic | np.ndarray) else value
