"""Records of entry points: methods, measures and finders of other distributions."""

from importlib.metadata import entry_points
from typing import TypeVar

from rockshape.errors import InputError

_Record = TypeVar("_Record")


def load_records(group: str, record: type[_Record]) -> tuple[_Record, ...]:
    """Records of a group of entry points, in the order of their names.

    Raises: InputError for an entry point that is no such record.
    """
    loaded = []
    for entry in sorted(entry_points(group=group), key=lambda entry: entry.name):
        found = entry.load()
        if not isinstance(found, record):
            raise InputError(
                f"entry point {entry.name!r} of {group}: expected a {record.__name__}, "
                f"found {type(found).__name__}"
            )
        loaded.append(found)
    return tuple(loaded)
