"""Keywords of the functions that make beds, laid over a specification."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypedDict

from synth.spec.bed import BedSpec, convert_bed_spec, load_bed_spec
from synth.spec.source import Table, check_names, merged, tables_of

BedSource = BedSpec | Table | str | Path


class BedOptions(TypedDict, total=False):
    """Keywords of `make_bed`: keys and tables of a `BedSpec`."""

    seed: int
    tiles: int
    width_px: int
    height_px: int
    tilt_deg: Sequence[float]
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
    check_names(options, BedOptions.__annotations__, where=where)
    table = tables_of(source, BedSpec, load_bed_spec, where=where)
    return convert_bed_spec(merged(merged({}, table), options), where=where)
