"""Sample: the rocks of tables that are counted, and those that are left out."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Floats
from rockshape.rock.flags import SOFT_OUTLINE
from rockshape.samples.percentiles import DRAWS, bootstrap_percentiles
from rockshape.samples.size_column import SizeColumn

if TYPE_CHECKING:
    import pandas as pd


AXES = ("axis_a_m", "axis_b_m", "axis_c_m")
FOUND_SD = 0.06  # of ln D of any percentile, where every rock was found in a picture alone


@dataclass(frozen=True, eq=False)
class Sample:
    """Counted rocks with their sizes; why others are left out, with their numbers."""

    table: "pd.DataFrame"  # of the counted rocks
    sizes: Floats  # (n,), in the unit of the column
    sds: Floats | None  # (n,)
    column: SizeColumn
    left_out: dict[str, int]

    def __len__(self) -> int:
        return len(self.sizes)

    @property
    def found_sd(self) -> float:
        """Standard deviation of a percentile's logarithm that comes from finding the rocks.

        It is `FOUND_SD` times the share of rocks whose outline is soft.
        """
        return FOUND_SD * float(self._soft.mean()) if len(self) else 0.0

    def bootstrap(self, power: float, percents: Sequence[float], *, draws: int = DRAWS) -> Floats:
        """Percentiles (draws, k) of the sizes, weighted by a power of them, of rocks drawn again.

        What finding the rocks does to sizes moves all percentiles of a draw alike.
        """
        return bootstrap_percentiles(
            self.sizes, power, percents, sd=self.sds, common_sd=self.found_sd, draws=draws
        )

    @property
    def half_axes_m(self) -> Floats:
        """Half-axes (k, 3), longest first, of the rocks that have all three."""
        if not all(name in self.table for name in AXES):
            return np.empty((0, 3))
        return self.table[list(AXES)].dropna().to_numpy(np.float64)

    @property
    def roundness(self) -> Floats:
        """Roundness (k,) of the rocks that have it and no soft outline."""
        if "roundness" not in self.table:
            return np.empty(0)
        return self.table["roundness"][~self._soft].dropna().to_numpy(np.float64)

    @property
    def soft_outlines(self) -> int:
        """Number of rocks whose roundness is left out because their outline is soft."""
        if "roundness" not in self.table:
            return 0
        return int(self.table["roundness"][self._soft].notna().sum())

    @property
    def _soft(self) -> NDArray[np.bool_]:
        """Which rocks (n,) are flagged to have a soft outline."""
        if "flags" not in self.table:
            return np.zeros(len(self.table), dtype=bool)
        flags = self.table["flags"].astype(str)
        return flags.str.contains(SOFT_OUTLINE, regex=False).to_numpy(bool)


def sample_of(
    table: "pd.DataFrame", column: SizeColumn, *, least: float | None = None, cut: bool = False
) -> Sample:
    """Sample of a table: rocks with a size, no smaller than `least`, whole in the frame.

    With `cut` those that the frame cuts count too; their size is that of what is in sight.
    """
    sizes = column.sizes(table)
    keep = np.ones(len(table), dtype=bool)
    left_out: dict[str, int] = {}

    def leave(reason: str, which: NDArray[np.bool_]) -> None:
        gone = int((keep & which).sum())
        if gone:
            left_out[reason] = gone
        np.logical_and(keep, ~which, out=keep)

    leave("without a size", ~(np.isfinite(sizes) & (sizes > 0)))
    if not cut and "truncated" in table:
        leave("cut by the frame", table["truncated"].to_numpy(bool))
    if least is not None:
        leave(f"smaller than {least:g} {column.unit}".rstrip(), sizes < least)
    sds = column.sds(table)
    return Sample(table[keep], sizes[keep], None if sds is None else sds[keep], column, left_out)
