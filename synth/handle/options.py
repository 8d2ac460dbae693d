"""Options of `make_scene`: keywords and other forms of a specification, made into one."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypedDict

import msgspec

from synth.spec import SceneSpec, convert_spec, load_spec
from synth.spec.site import with_site
from synth.spec.source import Table, check_names, merged, tables_of
from synth.spec.toml import read_toml

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

    site: str
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
    things: Table
    image: Table
    dataset: Table
    truth: Table


def spec_of(source: SpecSource | None, options: Mapping[str, Any]) -> SceneSpec:
    """Specification of a source, the default one if it is None, with options laid over it.

    Raises:
        SpecError: an option that does not exist, or a key or value that is not allowed.
    """
    where = "make_scene"
    check_names(options, SceneOptions.__annotations__, where=where)
    if isinstance(source, str | Path):
        load_spec(Path(source))  # a complaint names the file
        source = read_toml(Path(source))
    table = tables_of(source, SceneSpec, load_spec, where=where)
    said: Table = merged(merged({}, table), _tables(options))
    if not isinstance(source, SceneSpec) or "site" in options:
        said = with_site(said, where=where)
    return convert_spec(said, where=where)


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


def _tables(options: Mapping[str, Any]) -> dict[str, Any]:
    """Options as the tables of a specification."""
    tables = {
        name: {_SHORT[name]: value} if name in _SHORT and not isinstance(value, Mapping) else value
        for name, value in options.items()
        if name not in _OF_ROCKS
    }
    own = {name: options[name] for name in _OF_ROCKS if name in options}
    return merged(tables, {"rocks": own}) if own else tables
