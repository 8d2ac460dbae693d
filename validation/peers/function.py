"""Loader of a measure that is a Python function, `package.module:function`."""

import importlib
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

from validation.errors import InputError

Function = Callable[..., object]


@cache
def load_function(target: str) -> Function:
    """Function that `package.module:function` names; modules of the current folder are found too.

    Raises:
        InputError: no such module or function, or a package that it needs is missing.
    """
    module_name, _, name = target.partition(":")
    if str(Path.cwd()) not in sys.path:
        sys.path.append(str(Path.cwd()))
    try:
        module = importlib.import_module(module_name)
    except BaseException as error:  # SystemExit too
        raise InputError(
            f"--measure {target}: expected a module that can be imported, found: "
            f"{type(error).__name__}: {error}"
        ) from error
    function = getattr(module, name, None)
    if not callable(function):
        raise InputError(f"--measure {target}: expected a function {name} in {module_name}")
    found: Function = function
    return found
