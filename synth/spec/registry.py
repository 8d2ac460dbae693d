"""Registries of what a spec names: sensors and rock families, of this package and of others.

A record is found by its name, and its module is imported when it is first asked for. Others add
records by entry points (`synth.sensors`, `synth.families`) or by `register` in a running process.
"""

import pickle
from collections.abc import Mapping
from functools import cached_property
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Generic, Protocol, TypeVar

import msgspec
from msgspec import UNSET, Struct, UnsetType

from synth.errors import SpecError
from synth.spec.complaint import complaint
from synth.spec.wording import expected_one_of


class Record(Protocol):
    """Record of a registry."""

    @property
    def name(self) -> str:
        """The name by which a spec asks for it."""

    @property
    def options(self) -> type[Struct] | None:
        """The struct of its own options, if it has any."""


R = TypeVar("R", bound=Record)
K = TypeVar("K", bound=Record)


class Registry(Generic[R]):
    """Registry of records: the package's own, entry points', and those registered here."""

    def __init__(self, what: str, *, group: str, own: Mapping[str, str]) -> None:
        """Take what a record is called, the entry points' group, and name → module:attribute."""
        self.what, self._group = what, group
        self.own = tuple(own)
        self._own = {name: EntryPoint(name, value, group) for name, value in own.items()}
        self._loaded: dict[str, R] = {}
        self._registered: dict[str, R] = {}

    @property
    def names(self) -> tuple[str, ...]:
        """All names that a spec may use."""
        return tuple(dict.fromkeys([*self._own, *sorted(self._others), *self._registered]))

    def register(self, record: R) -> R:
        """Add a record to this process and to the worker processes that it starts; return it.

        A record of the same name registered before is replaced.

        Raises:
            SpecError: the name is taken by a record of the package or of an entry point.
        """
        if record.name in self._own or record.name in self._others:
            raise SpecError(f"{self.what} {record.name!r}: expected a new name, found one in use")
        self._registered[record.name] = record
        return record

    def find(self, name: str) -> R:
        """Record of a name.

        Raises:
            SpecError: no record has the name; the message begins with what was expected.
        """
        if name in self._registered:
            return self._registered[name]
        if name not in self._loaded:
            entry = self._own.get(name) or self._others.get(name)
            if entry is None:
                raise SpecError(expected_one_of(name, self.names))
            self._loaded[name] = self._load(entry)
        return self._loaded[name]

    def find_kind(self, name: str, kind: type[K]) -> K:
        """Record of a name, which must be of a class.

        Raises:
            SpecError: no record has the name, or what has it is of another class.
        """
        found: object = self.find(name)
        if not isinstance(found, kind):
            raise SpecError(f"{self.what} {name!r}: expected a {kind.__name__}, found {found!r}")
        return found

    def dump(self) -> bytes:
        """Registered records for another process, which must be able to import them.

        Raises:
            SpecError: a record is made from functions that no module holds.
        """
        for name, record in self._registered.items():
            try:
                data = pickle.dumps(record)
            except (pickle.PicklingError, AttributeError, TypeError) as error:
                raise SpecError(self._homeless(name, str(error))) from error
            if b"__main__" in data:
                raise SpecError(self._homeless(name, "__main__"))
        return pickle.dumps(self._registered)

    def load(self, data: bytes) -> None:
        """Take over the records that another process has dumped."""
        self._registered.update(pickle.loads(data))

    @cached_property
    def _others(self) -> Mapping[str, EntryPoint]:
        found = {entry.name: entry for entry in entry_points(group=self._group)}
        taken = [name for name in found if name in self._own]
        if taken:
            raise SpecError(
                f"entry point {found[taken[0]].value}: expected a new name for a {self.what}, "
                f"found {taken[0]!r}, which the package has"
            )
        return found

    def _load(self, entry: EntryPoint) -> R:
        try:
            record: R = entry.load()
        except Exception as error:  # of code from elsewhere, any
            raise SpecError(
                f"entry point {entry.value}: expected a {self.what}, "
                f"found {type(error).__name__}: {error}"
            ) from error
        if getattr(record, "name", None) != entry.name:
            raise SpecError(
                f"entry point {entry.value}: expected a {self.what} named {entry.name!r}, "
                f"found {getattr(record, 'name', record)!r}"
            )
        return record

    def _homeless(self, name: str, found: str) -> str:
        return (
            f"{self.what} {name!r}: expected one defined in a module that worker processes "
            f"can import, found {found}"
        )


def options_of(what: str, record: Record, given: Mapping[str, Any] | UnsetType) -> Struct | None:
    """Record's own options, from the table `options` of a spec.

    Raises:
        SpecError: a key or value that the record does not allow.
    """
    if record.options is None:
        if given is not UNSET and given:
            raise SpecError(f"options: expected none for the {what} {record.name!r}, found {given}")
        return None
    table = {} if given is UNSET else given
    try:
        return msgspec.convert(table, record.options)
    except msgspec.ValidationError as error:
        raise SpecError(f"options: {complaint(table, record.options)}") from error
