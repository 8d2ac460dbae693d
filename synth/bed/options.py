"""Keywords of the functions that make beds, laid over a specification."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypedDict

import msgspec

from synth.errors import SpecError
from synth.handle.options import merged
from synth.spec.bed import BedSpec, convert_bed_spec, load_bed_spec
from synth.spec.wording import unknown_name

Table = Mapping[str, Any]
BedSource = BedSpec | Table | str | Path


class BedOptions(TypedDict, total=False):
    """Keywords of `make_bed`: keys and tables of a `BedSpec`."""

    seed: int
    tiles: int
    width_px: int
    height_px: int
    supersample: int
    bodies: int
    grains: Table
    ground: Table
    light: Table
    photo: Table


def bed_spec_of(source: object, options: Mapping[str, Any], *, where: str) -> BedSpec:
    """Specification of a source, the default one if it is None, with options laid over it.

    Raises:
        SpecError: an option that does not exist, or a key or value that is not allowed.
    """
    for name in options:
        if name not in BedOptions.__annotations__:
            raise SpecError(
                f"{where}: {unknown_name('argument', name, BedOptions.__annotations__)}"
            )
    table: Table
    match source:
        case None:
            table = {}
        case BedSpec():
            table = msgspec.to_builtins(source)
        case str() | Path():
            table = msgspec.to_builtins(load_bed_spec(Path(source)))
        case Mapping():
            table = source
        case _:
            raise SpecError(
                f"{where}: spec: expected a path to a TOML file, a BedSpec or a table, "
                f"found {type(source).__name__}"
            )
    return convert_bed_spec(merged(table, options), where=where)
