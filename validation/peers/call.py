"""Calling conventions of a measure's function, told apart by the names of its parameters."""

import inspect
from collections.abc import Callable, Iterator, Mapping
from numbers import Real

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from rockshape.outline.edge import trace_edge
from rockshape.rock.instances import Instance, Instances
from validation.errors import InputError
from validation.peers.view_input import Seen, as_table, read_only

Function = Callable[..., object]

MARGIN_PX = 4  # of ground around each mask: no rock touches the border of its array
CONVENTIONS = (
    ("mask",),
    ("outline",),
    ("image", "labels"),
    ("image", "labels", "points_m"),
)
_WHOLE_VIEW = CONVENTIONS[-1]
_INPUTS = frozenset(name for names in CONVENTIONS for name in names)
_NO_INPUT = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)


def check_convention(function: Function, *, where: str) -> None:
    """Refuse a function that no calling convention fits.

    Raises:
        InputError: says which parameters were looked for and which were found.
    """
    _inputs_of(function, where=where)


def call_measure(function: Function, seen: Seen, *, where: str) -> object:
    """Result of a measure's function on one view, in a form that `as_table` takes.

    A function of a mask or an outline is called once a rock, in the rising order of the labels; one
    of image and labels once a view.

    Raises:
        InputError: the function fits no convention, raises an exception, or gives something other
            than a number or a mapping of numbers for a rock.
    """
    inputs = _inputs_of(function, where=where)
    if inputs is None:
        return _call(function, (seen.image, seen.labels, seen.points_m), {}, where=where)
    if len(inputs) == 1:
        return _columns(function, inputs[0], seen, where=where)
    view = {"image": seen.image, "labels": seen.labels, "points_m": seen.points_m}
    return _call_by_name(function, {name: view[name] for name in inputs}, where=where)


def measured_table(function: Function, seen: Seen, *, where: str) -> pd.DataFrame:
    """Table of one row a rock of a measure's function on one view; see `as_table`.

    Raises:
        InputError: as `call_measure` and `as_table`.
    """
    return as_table(call_measure(function, seen, where=where), seen.numbers, where=where)


def _inputs_of(function: Function, *, where: str) -> tuple[str, ...] | None:
    """Names of the inputs to pass; None for (image, labels, points_m) by position."""
    try:
        signature = inspect.signature(function)
    except ValueError:  # of compiled code: nothing is known of its parameters
        return None
    parameters = signature.parameters.values()
    asked = {
        each.name
        for each in parameters
        if each.kind not in _NO_INPUT and (each.default is each.empty or each.name in _INPUTS)
    }
    for names in CONVENTIONS:
        if asked == set(names):
            return names
    if _takes_three(signature):
        return None
    expected = ", ".join(f"({', '.join(names)})" for names in CONVENTIONS[:-1])
    raise InputError(
        f"{where}: expected a function with the parameters {expected} or "
        f"({', '.join(_WHOLE_VIEW)}), the last also under other names, found {signature}"
    )


def _takes_three(signature: inspect.Signature) -> bool:
    """Whether three arguments can be given by position and the first two must be, or are *args."""
    try:
        bound = signature.bind(*_WHOLE_VIEW)
    except TypeError:
        return False
    optional = [name for name in bound.arguments if _is_optional(signature.parameters[name])]
    return len(optional) <= 1


def _is_optional(parameter: inspect.Parameter) -> bool:
    return parameter.default is not parameter.empty


def _call_by_name(function: Function, inputs: Mapping[str, object], *, where: str) -> object:
    """Call with each input at its parameter, in whatever order and of whatever kind those are."""
    signature = inspect.signature(function)
    bound = signature.bind_partial()
    bound.arguments |= {name: inputs[name] for name in signature.parameters if name in inputs}
    return _call(function, bound.args, bound.kwargs, where=where)


def _call(
    function: Function, args: tuple[object, ...], kwargs: Mapping[str, object], *, where: str
) -> object:
    try:
        return function(*args, **kwargs)
    except BaseException as error:  # SystemExit and KeyboardInterrupt too
        raise InputError(f"{where}: {type(error).__name__}: {error}") from error


def _columns(function: Function, name: str, seen: Seen, *, where: str) -> dict[str, list[float]]:
    """Columns of a function of one rock, a number a rock; the column of a bare number is `value`.

    Raises:
        InputError: a rock has other columns than the first, or what is no number.
    """
    columns: dict[str, list[float]] = {}
    for index, (number, shape) in enumerate(_SHAPES[name](seen)):
        here = f"{where}: rock {number}"
        given = _call_by_name(function, {name: shape}, where=here)
        row = given if isinstance(given, Mapping) else {"value": given}
        if index == 0:
            columns = {str(column): [] for column in row}
            if "rock" in columns:
                raise InputError(f"{here}: expected columns other than rock, found it")
        if set(map(str, row)) != set(columns):
            raise InputError(
                f"{here}: expected the columns of the first rock, {', '.join(columns)}, "
                f"found {', '.join(map(str, row)) or 'none'}"
            )
        for column, value in row.items():
            columns[str(column)].append(_number(value, where=here))
    return columns


def _number(value: object, *, where: str) -> float:
    scalar = value[()] if isinstance(value, np.ndarray) and value.ndim == 0 else value
    if isinstance(scalar, Real | np.bool_):
        return float(scalar)
    raise InputError(
        f"{where}: expected a number or a mapping of numbers, found {type(value).__name__}"
    )


def _masks(seen: Seen) -> Iterator[tuple[int, NDArray[np.bool_]]]:
    """Each rock's number and mask (rows, cols): its largest connected part with a margin."""
    for rock in Instances.from_labels(seen.labels).largest_parts():
        yield rock.id, read_only(np.pad(rock.mask, MARGIN_PX))


def _outlines(seen: Seen) -> Iterator[tuple[int, NDArray[np.float64]]]:
    """Each rock's number and outline (n, 2), x and y in the image's pixels.

    As found to sub-pixel, or else the edge of the mask (`trace_edge`).
    """
    for rock in Instances.from_labels(seen.labels).largest_parts():
        found = seen.outlines_px.get(rock.id)
        outline = trace_edge(rock.mask) + _corner_px(rock) if found is None else found
        yield rock.id, read_only(outline)


def _corner_px(rock: Instance) -> tuple[int, int]:
    rows, cols = rock.window
    return cols.start, rows.start


_SHAPES: Mapping[str, Callable[[Seen], Iterator[tuple[int, NDArray[np.generic]]]]] = {
    "mask": _masks,
    "outline": _outlines,
}
