"""Input and output records of a measure from elsewhere."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from rockshape.rock.instances import Instances
from validation.errors import InputError
from validation.records.join import RecordKey

MAX_COLUMNS = 256
_MAX_NAME = 80  # characters
# Columns that the records have beside a measure's own.
_RESERVED = frozenset(
    {*RecordKey.__dataclass_fields__}
    | {"instance", "obj_id", "family", "eligible", "iou", "status", "reason"}
)
_TRUTH = "truth_"
A = TypeVar("A", bound=np.generic)


def read_only(values: NDArray[A]) -> NDArray[A]:
    """View of an array that cannot be written to."""
    view = values.view()
    view.flags.writeable = False
    return view


@dataclass(frozen=True, eq=False)
class Seen:
    """One view as it is passed to a measure.

    outlines_px are the outlines (n, 2) that were found to sub-pixel, by the rock's number; of other
    rocks the edge of the mask is the outline.
    """

    image: NDArray[np.float32]  # (rows, cols), 0..1
    labels: NDArray[np.int32]  # (rows, cols), 0 the ground
    points_m: NDArray[np.float64] | None  # (rows, cols, 3) in the camera frame, NaN where unknown
    outlines_px: Mapping[int, NDArray[np.float64]] = field(default_factory=dict)

    @property
    def numbers(self) -> NDArray[np.int64]:
        """The rocks' numbers, rising."""
        found: NDArray[np.int64] = np.unique(self.labels[self.labels > 0]).astype(np.int64)
        return found

    def read_only(self) -> "Seen":
        """View whose arrays cannot be written to."""
        points_m = None if self.points_m is None else read_only(self.points_m)
        outlines_px = {number: read_only(each) for number, each in self.outlines_px.items()}
        return Seen(read_only(self.image), read_only(self.labels), points_m, outlines_px)


def outlines_px(rocks: Instances) -> dict[int, NDArray[np.float64]]:
    """Outline (n, 2) of each rock that has one found to sub-pixel, by its number."""
    return {rock.id: rock.outline_px for rock in rocks if rock.outline_px is not None}


def as_table(given: object, numbers: NDArray[np.int64], *, where: str) -> pd.DataFrame:
    """Table of a measure's result: `rock` and a column for each quantity.

    `given` maps each column to one number a rock, in the order of `numbers`; an array alone is
    the column `value`; a table with the column `rock` may leave rocks out.

    Raises:
        InputError: it is none of these, or holds something other than numbers.
    """
    if isinstance(given, pd.DataFrame) and "rock" in given:
        columns: Mapping[str, object] = {str(name): given[name] for name in given}
    elif isinstance(given, pd.DataFrame | Mapping):
        columns = {"rock": numbers, **{str(name): given[name] for name in given}}
    else:
        columns = {"rock": numbers, "value": given}
    _check_names(columns, where=where)
    values = {}
    for name, column in columns.items():
        values[name] = _numbers(column, where=f"{where}: {name}")
        if values[name].ndim != 1 or values[name].size != values["rock"].size:
            raise InputError(
                f"{where}: {name}: expected one number for each of {values['rock'].size} rocks, "
                f"found the shape {values[name].shape}"
            )
    rocks = values["rock"]
    if not np.isin(rocks, numbers).all() or np.unique(rocks).size < rocks.size:
        raise InputError(f"{where}: rock: expected numbers of the labels, each once, found others")
    table = pd.DataFrame(values).astype({"rock": np.int64})
    every = pd.DataFrame({"rock": numbers})
    return every.merge(table, on="rock", how="left").assign(reason="")


def _numbers(column: object, *, where: str) -> NDArray[np.float64]:
    try:
        stored = np.asarray(column)
        numbers = stored.astype(np.float64) if stored.dtype.kind in "biufO" else None
    except (TypeError, ValueError, OverflowError) as error:
        raise InputError(f"{where}: expected numbers, found {error}") from error
    if numbers is None:
        raise InputError(f"{where}: expected numbers, found {stored.dtype}")
    return numbers


def _check_names(names: Collection[str], *, where: str) -> None:
    """Refuse columns that the records have already, and names that cannot stand in a score's."""
    if len(names) > MAX_COLUMNS:
        raise InputError(f"{where}: expected at most {MAX_COLUMNS} columns, found {len(names)}")
    for name in names:
        if name in _RESERVED or name.startswith(_TRUTH):
            raise InputError(
                f"{where}: expected names of columns that the records do not have, found {name!r}"
            )
        if not 0 < len(name) <= _MAX_NAME or not name.isprintable():
            raise InputError(
                f"{where}: expected names of columns of 1 to {_MAX_NAME} printable characters, "
                f"found {name[:_MAX_NAME]!r}"
            )
