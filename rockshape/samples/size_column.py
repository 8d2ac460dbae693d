"""Size of a grain: the column of a table that it is read from, and its unit."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rockshape.errors import InputError, did_you_mean
from rockshape.numerics.arrays import Floats

if TYPE_CHECKING:
    import pandas as pd

# intermediate axis first, which sieves part by: in plan it is the minor axis
DEFAULTS = ("minor_axis_mm", "feret_min_mm", "axis_b_m", "minor_axis_px", "feret_min_px")
_HALF_AXIS = re.compile(r"axis_[abc]_m")
_MM = {"mm": 1.0, "m": 1000.0}


@dataclass(frozen=True)
class SizeColumn:
    """Column of sizes, and what makes them whole diameters in mm or px."""

    name: str
    unit: str  # mm, px, or empty for another
    factor: float

    def sizes(self, table: "pd.DataFrame") -> Floats:
        """Sizes (n,) in the unit; NaN where a rock has none."""
        return self.factor * table[self.name].to_numpy(np.float64)

    def sds(self, table: "pd.DataFrame") -> Floats | None:
        """Standard uncertainties (n,) where the table has a column `<name>_sd`."""
        name = f"{self.name}_sd"
        return self.factor * table[name].to_numpy(np.float64) if name in table else None


def size_column(table: "pd.DataFrame", name: str | None) -> SizeColumn:
    """Column that was named, or the first of `DEFAULTS` with a size above 0.

    Raises: InputError where there is none, or where the one named holds no numbers.
    """
    if name is not None:
        if name not in table:
            hint = did_you_mean(name, list(table.columns))
            raise InputError(f"size (--size): expected a column of the table, found {name!r}{hint}")
        if table[name].dtype.kind not in "fiu":
            raise InputError(f"size (--size): expected numbers in column {name!r}, found text")
        return _column(name)
    for each in DEFAULTS:
        if each in table and bool((table[each].to_numpy(np.float64) > 0).any()):
            return _column(each)
    raise InputError(
        f"table: expected a column of sizes, one of {_listed(DEFAULTS)} "
        "(rockshape measure --sizes or --scale adds them), found none with a value"
    )


def _column(name: str) -> SizeColumn:
    suffix = name.rpartition("_")[2]
    halves = 2.0 if _HALF_AXIS.fullmatch(name) else 1.0
    if suffix in _MM:
        return SizeColumn(name, "mm", halves * _MM[suffix])
    return SizeColumn(name, "px" if suffix == "px" else "", halves)


def _listed(names: Sequence[str]) -> str:
    return ", ".join(names)
