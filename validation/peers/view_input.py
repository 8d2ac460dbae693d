"""Input and output records of a measure from elsewhere."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.errors import InputError


@dataclass(frozen=True, eq=False)
class Seen:
    """One view as it is passed to a measure."""

    image: NDArray[np.float32]  # (rows, cols), 0..1
    labels: NDArray[np.int32]  # (rows, cols), 0 the ground
    points_m: NDArray[np.float64] | None  # (rows, cols, 3) in the camera frame, NaN where unknown

    @property
    def numbers(self) -> NDArray[np.int64]:
        """The rocks' numbers, rising."""
        found: NDArray[np.int64] = np.unique(self.labels[self.labels > 0]).astype(np.int64)
        return found


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
    values = {}
    for name, column in columns.items():
        try:
            values[name] = np.asarray(column, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(f"{where}: {name}: expected numbers, found {error}") from error
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
