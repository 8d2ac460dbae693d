"""Plug-in modules of a suite: they register methods and kinds when they are imported."""

import sys
from functools import cache
from importlib import import_module
from pathlib import Path
from types import ModuleType

from rockshape.method import Method, register_method
from validation.errors import InputError


@cache
def load_plugin(plugin: str) -> ModuleType:
    """Import `package.module`, also of the current folder, and register `:NAME`, a Method, in it.

    Raises:
        InputError: no such module or record.
    """
    module_name, _, name = plugin.partition(":")
    if str(Path.cwd()) not in sys.path:
        sys.path.append(str(Path.cwd()))
    try:
        module = import_module(module_name)
    except (Exception, SystemExit) as error:
        raise InputError(
            f"plug-in {plugin}: expected a module that can be imported, found: "
            f"{type(error).__name__}: {error}"
        ) from error
    if name:
        register_method(_method_in(module, name))
    return module


def load_method(reference: str) -> Method:
    """Import and register the Method at `package.module:NAME`.

    Raises:
        InputError: no such module or record.
    """
    return _method_in(load_plugin(reference), reference.partition(":")[2])


def _method_in(module: ModuleType, name: str) -> Method:
    record = getattr(module, name, None)
    if not isinstance(record, Method):
        raise InputError(
            f"{module.__name__}:{name}: expected a Method, found {type(record).__name__}"
        )
    return record
