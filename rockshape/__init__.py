"""Shape of rocks, measured from an image and its range.

`measure` takes arrays, `read` reads files; each measure is a function of one rock's mask, outline
or points, `roundness(mask)` for instance. Names are imported when they are first asked for.

The parts, in the order data flows through them: `io` reads files, `observation` holds an image and
its range, `inputs` makes it of arrays or files, `ground` and `segmentation` find the rocks,
`outline`, `ellipse`, `ellipsoid` and `surface` fit each, `measures` turns fits into numbers,
`method` says which, `uncertainty` how sure they are, `pipeline` joins all that, `measurement` is
the result with its table, and `report` and `export` show it.
"""

import lazy_loader

_public, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> object:
    """Public name; the version is the distribution's."""
    if name == "__version__":
        from importlib.metadata import version  # noqa: PLC0415 - it takes as long as all else

        return version("rockshape")
    return _public(name)
