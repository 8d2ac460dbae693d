"""Complaints about a spec: the key, what was expected there and what was found."""

import re
from typing import Any, get_args, get_type_hints

from msgspec import Struct


def complaint(error: str, table: object, kind: type[Struct]) -> str:
    """Return msgspec's error about plain tables as `key: expected …, found …`.

    msgspec tells the place as a path, `$.rocks.diameter_m[0]`; a table's own checks begin with the
    key that they are about, and their place is the table's.
    """
    text, _, place = error.partition(" - at `$")
    path = place.strip(".`")
    unknown = re.fullmatch(r"Object contains unknown field `(.*)`", text)
    if unknown:
        keys = ", ".join(_kind(kind, path).__struct_fields__)
        return f"{_dotted(path, unknown[1])}: expected one of {keys}, found a key of this name"
    if text.startswith("Invalid enum value"):
        names = ", ".join(str(name) for name in get_args(_kind(kind, path)))
        return f"{path}: expected one of {names}, found {_value(table, path)!r}"
    if text.startswith("Expected "):
        wanted = text.removeprefix("Expected ").partition(", got")[0].replace("`", "")
        return f"{f'{path}: ' if path else ''}expected {wanted}, found {_value(table, path)!r}"
    return _dotted(path, text)


def _dotted(path: str, rest: str) -> str:
    return f"{path}.{rest}" if path else rest


def _kind(kind: Any, path: str) -> Any:
    """Return the type of the key at a path."""
    for name in filter(None, path.split(".")):
        kind = get_type_hints(kind)[name]
    return kind


def _value(table: Any, path: str) -> Any:
    """Return what plain tables hold at a path."""
    for index, name in re.findall(r"\[(\d+)\]|(\w+)", path):
        table = table[int(index)] if index else table[name]
    return table
