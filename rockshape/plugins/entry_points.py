"""Records of entry points: methods, measures, finders and kinds of other distributions."""

from collections.abc import Iterable
from importlib.metadata import entry_points
from typing import Protocol, TypeVar

from rockshape.errors import InputError


class _Named(Protocol):
    @property
    def name(self) -> str: ...


_Record = TypeVar("_Record")
_NamedRecord = TypeVar("_NamedRecord", bound=_Named)


def load_records(group: str, record: type[_Record]) -> tuple[_Record, ...]:
    """Records of a group of entry points, in the order of their names.

    Raises: InputError for an entry point that cannot be imported or is no such record.
    """
    loaded = []
    for entry in sorted(entry_points(group=group), key=lambda entry: entry.name):
        where = f"entry point {entry.name!r} of {group}: expected a {record.__name__}"
        try:
            found = entry.load()
        except Exception as error:  # of code from elsewhere, any
            raise InputError(f"{where}, found {type(error).__name__}: {error}") from error
        if not isinstance(found, record):
            raise InputError(f"{where}, found {type(found).__name__}")
        loaded.append(found)
    return tuple(loaded)


def with_entry_points(
    own: Iterable[_NamedRecord], group: str, record: type[_NamedRecord]
) -> dict[str, _NamedRecord]:
    """Records by name: the package's own, then those of a group of entry points.

    Raises: InputError for an entry point that is no such record or takes another's name.
    """
    found = {each.name: each for each in own}
    for each in load_records(group, record):
        if each.name in found:
            raise InputError(f"{group}: expected a name of its own, found {each.name!r}")
        found[each.name] = each
    return found
