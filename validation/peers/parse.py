"""Parser of `--measure` and `--expected-trait`, and the trial of a measure before a run."""

import re
from collections.abc import Mapping, Sequence
from pathlib import PurePath
from typing import cast, get_args

import msgspec
import numpy as np

from validation.errors import InputError
from validation.peers.adapters import ADAPTERS
from validation.peers.command import check_command
from validation.peers.declare import VALUE, Trait
from validation.peers.run import declared_by, run_measure
from validation.peers.spec import MeasureSpec
from validation.peers.view_input import Seen

_NAMED = re.compile(r"(?P<name>[a-z][a-z0-9_-]*)=(?P<rest>.+)", re.DOTALL)
_FUNCTION = re.compile(r"\w+(\.\w+)*:\w+")
_PROBE_SIDE_PX = 96
TRIAL_LIMIT_S = 60.0
_BY_NAME: dict[str, Trait] = {
    "angularity": "angularity",
    "roundness": "roundness",
    "roughness": "roughness",
    "sphericity": "form",
    "axis_ratio": "form",
}


def parse_measure(text: str) -> MeasureSpec:
    """Specification from `[NAME=]package.module:function`, a command or the name of a peer.

    Raises:
        InputError: it is none of these, or a command without {labels} or {out}.
    """
    named = _NAMED.fullmatch(text)
    name, rest = (named["name"], named["rest"]) if named else ("", text)
    if rest in ADAPTERS:
        return _spec(name or rest, function=ADAPTERS[rest])
    if _FUNCTION.fullmatch(rest):
        return _spec(name or _name_of(rest.partition(":")[2]), function=rest)
    if "{" not in rest:
        raise InputError(
            "--measure: expected package.module:function, a command with {labels} and {out}, "
            f"or one of {', '.join(ADAPTERS)}, found {rest!r}"
        )
    check_command(rest)
    return _spec(name or _name_of(PurePath(rest.split()[0]).stem), command=rest)


def _name_of(text: str) -> str:
    return re.sub(r"[^a-z0-9_-]", "_", text.lower()).lstrip("0123456789_-") or "measure"


def _spec(name: str, *, function: str | None = None, command: str | None = None) -> MeasureSpec:
    try:
        return MeasureSpec(name=name, function=function, command=command)
    except ValueError as error:
        raise InputError(f"--measure: {error}: put NAME= before it") from error


def parse_traits(texts: Sequence[str]) -> dict[str, Trait]:
    """Expected trait by column, from words COLUMN=TRAIT.

    Raises:
        InputError: no such trait.
    """
    traits = get_args(Trait)
    found: dict[str, Trait] = {}
    for text in texts:
        column, _, trait = text.partition("=")
        if not column or trait not in traits:
            raise InputError(
                f"--expected-trait: expected COLUMN={'|'.join(traits)}, found {text!r}"
            )
        found[column] = cast(Trait, trait)
    return found


def settle(spec: MeasureSpec, asked: Mapping[str, Trait]) -> MeasureSpec:
    """Return the measure with the expected trait of each column that is judged.

    The measure is tried on a small view of two hemispheres, so that one that does not work is found
    before any scene is made, and its columns become known. A column's trait is that of `asked`,
    else of the suite, else of the function's own declaration, else of the column's name where it
    names a trait (for the bare numbers of a function, the function's name). A column without a
    trait is stored but not judged.

    Raises:
        InputError: the measure fails on the trial view, lacks a column that was named, or has none
            that can be judged.
    """
    declared = declared_by(spec)
    table = run_measure(spec, _probe(), limit_s=TRIAL_LIMIT_S)
    columns = [str(name) for name in table.columns if name not in ("rock", "reason")]
    named = {name: _BY_NAME[name] for name in columns if name in _BY_NAME}
    if spec.function is not None:
        own_name = spec.function.partition(":")[2]
        if VALUE in columns and own_name in _BY_NAME:
            named[VALUE] = _BY_NAME[own_name]
    given = {column: trait for column, trait in asked.items() if column in columns}
    traits = {**named, **_known(declared, spec), **spec.expected_trait, **given}
    missing = [column for column in traits if column not in columns]
    if missing:
        raise InputError(
            f"--measure {spec.name}: expected the column {missing[0]}, found {', '.join(columns)}"
        )
    if not traits:
        raise InputError(
            f"--measure {spec.name}: expected --expected-trait COLUMN={'|'.join(get_args(Trait))} "
            f"for one of its columns, found none for {', '.join(columns)}"
        )
    return msgspec.structs.replace(spec, expected_trait=traits)


def _known(declared: Mapping[str, str], spec: MeasureSpec) -> dict[str, Trait]:
    """Traits that a function declares, each one that there is."""
    traits = get_args(Trait)
    for column, trait in declared.items():
        if trait not in traits:
            raise InputError(
                f"--measure {spec.name}: expected_trait: {column}: "
                f"expected one of {', '.join(traits)}, found {trait!r}"
            )
    return cast(dict[str, Trait], dict(declared))


def _probe() -> Seen:
    """Trial view: two hemispheres of 30 cm radius on a plane 3 m away, seen from straight above."""
    focal_px = 300.0
    rows, cols = np.mgrid[0:_PROBE_SIDE_PX, 0 : 2 * _PROBE_SIDE_PX].astype(np.float64)
    depth_m = np.full(rows.shape, 3.0)
    labels = np.zeros(rows.shape, np.int32)
    for number, centre_col in enumerate((48.0, 144.0), start=1):
        across_m = np.hypot(rows - 48.0, cols - centre_col) * 3.0 / focal_px
        rise_m = np.sqrt(np.clip(0.3**2 - across_m**2, 0.0, None))
        labels[across_m < 0.3] = number
        depth_m -= rise_m
    x, y = (cols - _PROBE_SIDE_PX) * depth_m / focal_px, (rows - 48.0) * depth_m / focal_px
    image = np.where(labels > 0, 0.7, 0.3).astype(np.float32)
    return Seen(image, labels, np.stack([x, y, depth_m], axis=-1))
