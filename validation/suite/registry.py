"""Registry of the kinds of experiments: those of this package, of plug-ins and of the process."""

import pkgutil
from functools import cache
from importlib import import_module
from importlib.util import find_spec

from rockshape.plugins.entry_points import with_entry_points
from synth.spec.wording import expected_one_of
from validation.errors import InputError
from validation.suite.experiment import Experiment
from validation.suite.kind import Kind, Table

GROUP = "rockshape.kinds"  # entry points, each naming a Kind
_PACKAGE = "validation.kinds"  # a folder each, whose __init__ has KIND

_registered: dict[str, Kind] = {}


@cache
def installed_kinds() -> dict[str, Kind]:
    """Kinds of this package's folders, then those of installed plug-ins.

    Raises:
        InputError: an entry point that is no Kind, or takes another's name.
    """
    spec = find_spec(_PACKAGE)
    folders = pkgutil.iter_modules(spec.submodule_search_locations if spec else None)
    kinds: list[Kind] = [
        import_module(f"{_PACKAGE}.{each.name}").KIND for each in folders if each.ispkg
    ]
    return with_entry_points(kinds, GROUP, Kind)


def kinds() -> dict[str, Kind]:
    """All kinds by name; one that is registered replaces a found one of its name."""
    return installed_kinds() | _registered


def register_kind(kind: Kind) -> Kind:
    """Add a kind in this process; return it.

    Called in the module that defines the spec, it is known in workers too: they import that module
    when they read a unit.
    """
    _registered[kind.name] = kind
    return kind


def kind_named(name: str) -> Kind:
    """Kind of a name or an alias.

    Raises:
        InputError: no such kind.
    """
    known = kinds()
    aliased = {alias: kind for kind in known.values() for alias in kind.aliases if not kind.adopts}
    if name in known:
        return known[name]
    if name in aliased:
        return aliased[name]
    raise InputError(f"kind: {expected_one_of(name, known)}")


def kind_of_table(table: Table) -> Kind:
    """Kind of a suite's table, also where it has an older name.

    Raises:
        InputError: no such kind.
    """
    name = str(table.get("kind", ""))
    for kind in kinds().values():
        if name in kind.aliases and kind.adopts is not None and kind.adopts(table):
            return kind
    return kind_named(name)


def kind_of(experiment: Experiment) -> Kind:
    """Kind of a spec.

    Raises:
        InputError: its kind is not registered in this process.
    """
    return kind_named(str(type(experiment).__struct_config__.tag))
