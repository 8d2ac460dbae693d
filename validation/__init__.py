"""Validation of rock measures against rocks whose shape is known, with gates and reports.

`score` matches a measurement with one view's truth, `run` runs a suite, `compare` holds two runs
side by side. Names are imported when they are first asked for.

The data flow one way: suite → work units → matched records → scores → gates → report.
"""

import lazy_loader

_public, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> object:
    """Public name; the version is the distribution's."""
    if name == "__version__":
        from importlib.metadata import version  # noqa: PLC0415 - it takes as long as all else

        return version("rockshape")
    return _public(name)
