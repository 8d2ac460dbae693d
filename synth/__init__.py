"""Rocks of exactly known shape, seen by a known camera, with their ground truth.

`make_scene` gives a scene whose views are rendered on demand, `make_bed` a gravel bed,
`make_shapes` drawn shapes. Names are imported when they are first asked for.

The parts, in the order data flows through them: `spec` describes a dataset, `rocks` are drawn from
it, `scene` lays them on the ground, `camera` and `light` see it, `render` and `sensor` make images
and range, `dataset` writes them with their truth; `shapes` draws outlines in the plane, `bed` packs
grains on a height field.
"""

import lazy_loader

_public, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> object:
    """Return a public name; the version is the distribution's."""
    if name == "__version__":
        from importlib.metadata import version  # noqa: PLC0415 - it takes as long as all else

        return version("rockshape")
    return _public(name)
