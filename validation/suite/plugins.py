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
    except ImportError as error:
        raise InputError(
            f"plug-in {plugin}: expected a module that can be imported, found: {error}"
        ) from error
    if name:
        record = getattr(module, name, None)
        if not isinstance(record, Method):
            raise InputError(
                f"plug-in {plugin}: expected a Method named {name} in {module_name}, "
                f"found {type(record).__name__}"
            )
        register_method(record)
    return module
