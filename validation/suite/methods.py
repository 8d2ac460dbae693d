"""Methods of a suite: names, or records of modules that workers can import."""

import sys
from collections.abc import Sequence

import msgspec

from rockshape.method import BUILT_IN, Method, find_method
from validation.errors import InputError
from validation.suite.plugins import load_method
from validation.suite.suite import Suite


def with_methods(suite: Suite, methods: Sequence[str | Method]) -> Suite:
    """Suite whose experiments, where they measure, are measured by these methods.

    A method is a name, `package.module:NAME` or a Method record that a module defines; the suite's
    plug-ins grow by those modules, so that workers import them.

    Raises:
        InputError: a name that no method has, or a record that no module defines.
    """
    references = [_reference(method) for method in methods]
    plugins = [reference for reference in references if ":" in reference]
    found = [load_method(each) if ":" in each else find_method(each) for each in references]
    names = tuple(dict.fromkeys(method.name for method in found))
    return msgspec.structs.replace(
        suite,
        experiments=tuple(each.measured_by(names) for each in suite.experiments),
        plugins=tuple(dict.fromkeys([*suite.plugins, *plugins])),
    )


def _reference(method: str | Method) -> str:
    """Name of a built-in method, or the module and name at which a record can be imported."""
    if isinstance(method, str):
        return method
    if not isinstance(method, Method):
        raise InputError(
            f"methods: expected names or Method records, found {type(method).__name__}"
        )
    if method.name in BUILT_IN:
        return method.name
    for module_name, module in list(sys.modules.items()):
        if module is not sys.modules["__main__"]:  # nor its alias __mp_main__
            for name, value in list(getattr(module, "__dict__", {}).items()):
                if value is method:
                    return f"{module_name}:{name}"
    raise InputError(
        f"methods: expected a Method that a module other than the main script defines, so that "
        f"worker processes can import it, found {method.name!r}"
    )
