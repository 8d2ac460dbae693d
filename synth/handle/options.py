"""Options of `make_scene`: keywords and other forms of a specification, made into one."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypedDict

import msgspec
import numpy as np

from synth.errors import SpecError
from synth.spec import SceneSpec, convert_spec, load_spec
from synth.spec.wording import unknown_name

Table = Mapping[str, Any]
SpecSource = SceneSpec | Table | str | Path

# The key of each table that a plain value stands for.
_SHORT = {
    "rocks": "count",
    "views": "count",
    "camera": "preset",
    "noise": "kind",
    "population": "kind",
}
_OF_ROCKS = ("family", "series")


class SceneOptions(TypedDict, total=False):
    """Keywords of `make_scene`."""

    seed: int
    scenes: int
    renderer: str
    rocks: int | Table
    family: str
    series: str
    views: int | Table
    camera: str | Table
    noise: str | Table
    population: str | Table
    ground: Table
    surface: Table
    sun: Table
    sensor: Table
    calibration: Table
    light: Table
    tints: Table
    image: Table
    dataset: Table
    truth: Table


def spec_of(source: SpecSource | None, options: Mapping[str, Any]) -> SceneSpec:
    """Specification of a source, the default one if it is None, with options laid over it.

    Raises:
        SpecError: an option that does not exist, or a key or value that is not allowed.
    """
    where = "make_scene"
    for name in options:
        if name not in SceneOptions.__annotations__:
            raise SpecError(
                f"{where}: {unknown_name('argument', name, SceneOptions.__annotations__)}"
            )
    return convert_spec(plain(merged(_table(source), _tables(options))), where=where)


def with_noise(spec: SceneSpec, noise: str | Table | None) -> SceneSpec:
    """Specification with another sensor: its name, or keys of the table [noise].

    Raises:
        SpecError: no such sensor, or a key or value that is not allowed.
    """
    if noise is None:
        return spec
    return convert_spec(
        merged(msgspec.to_builtins(spec), _tables({"noise": noise})), where="render"
    )


def _table(source: object) -> Table:
    """Plain tables of a specification in any of its forms."""
    table: Table = {}
    if isinstance(source, SceneSpec):
        table = msgspec.to_builtins(source)
    elif isinstance(source, str | Path):
        table = msgspec.to_builtins(load_spec(Path(source)))
    elif isinstance(source, Mapping):
        table = source
    elif source is not None:
        raise SpecError(
            "make_scene: spec: expected a path to a TOML file, a SceneSpec or a table, "
            f"found {type(source).__name__}"
        )
    return table


def _tables(options: Mapping[str, Any]) -> dict[str, Any]:
    """Options as the tables of a specification."""
    tables = {
        name: {_SHORT[name]: value} if name in _SHORT and not isinstance(value, Mapping) else value
        for name, value in options.items()
        if name not in _OF_ROCKS
    }
    own = {name: options[name] for name in _OF_ROCKS if name in options}
    return merged(tables, {"rocks": own}) if own else tables


def plain(table: Table) -> dict[str, Any]:
    """Table with Python's numbers and lists in place of numpy's."""
    return {
        key: plain(value)
        if isinstance(value, Mapping)
        else value.tolist()
        if isinstance(value, np.generic | np.ndarray)
        else value
        for key, value in table.items()
    }


def merged(one: Table, two: Table) -> dict[str, Any]:
    """The first table with what the second says; tables within are merged, all else replaced."""
    both = {**one, **two}
    for key in one.keys() & two.keys():
        if isinstance(one[key], Mapping) and isinstance(two[key], Mapping):
            both[key] = merged(one[key], two[key])
    return both
