"""Ranking of rocks by a value whose uncertainty is known."""

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import ndtr

from rockshape.errors import InputError, did_you_mean
from rockshape.numerics.arrays import Floats
from rockshape.uncertainty import COVERAGE, uncertainty_columns

if TYPE_CHECKING:
    import pandas as pd

DRAWS = 4000
_NAMES = ("table", "image", "rock")  # columns that say which rock it is
_CELLS = 4_000_000  # drawn at once


def rank(table: "pd.DataFrame", by: str, *, ascending: bool = False) -> "pd.DataFrame":
    """Rocks of a table in the order of a column, the highest first, with what is sure of it.

    The errors are taken as normal, with the column's `…_sd`, and independent. `before_next` is the
    probability that a rock truly comes before the next; `first` that it comes before all others;
    `rank_low` and `rank_high` hold its true rank with 90 %. Rocks without a value are left out.
    Equal values have the table's order.

    Raises: InputError for a column that the table has not, or whose uncertainty it has not,
        and for uncertainties that cannot be.
    """
    import pandas as pd  # noqa: PLC0415 - it takes as long as all else

    sd_name, low_name, high_name = uncertainty_columns(by)
    if by not in table:
        hint = did_you_mean(by, list(table.columns))
        raise InputError(f"by (--by): expected a column of the table, found {by!r}{hint}")
    if sd_name not in table:
        known = [name for name in map(str, table) if uncertainty_columns(name)[0] in table]
        raise InputError(
            f"by (--by): expected a value with its uncertainty, {sd_name}, found none"
            + (f"; the table has {', '.join(known)}" if known else ": measure with --uncertainty")
        )
    table = _with_numbers(table, [name for name in (by, *uncertainty_columns(by)) if name in table])
    _check_uncertainty(table, by)
    known = table[np.isfinite(table[by]) & np.isfinite(table[sd_name])]
    order = np.argsort(known[by].to_numpy() * (1 if ascending else -1), kind="stable")
    known = known.iloc[order]
    value, sd = known[by].to_numpy(dtype=float), known[sd_name].to_numpy(dtype=float)
    sign = -1.0 if ascending else 1.0
    low, high, first = _places(sign * value, sd)
    names = {name: known[name].to_numpy() for name in _NAMES if name in known}
    ends = {name: known[name].to_numpy() for name in (low_name, high_name) if name in known}
    return pd.DataFrame(
        {
            "rank": np.arange(1, len(known) + 1),
            **names,
            by: value,
            sd_name: sd,
            **ends,
            "before_next": _before_next(sign * value, sd),
            "first": first,
            "rank_low": low,
            "rank_high": high,
        }
    )


def _with_numbers(table: "pd.DataFrame", columns: list[str]) -> "pd.DataFrame":
    """Table with columns as numbers, NaN where a cell is empty.

    Raises: InputError for a cell that is neither empty nor a finite number.
    """
    import pandas as pd  # noqa: PLC0415 - it takes as long as all else

    numbers = {name: pd.to_numeric(table[name], errors="coerce") for name in columns}
    for name, found in numbers.items():
        wrong = np.isinf(found) | (found.isna() & table[name].notna())
        if wrong.any():
            row = int(np.argmax(wrong.to_numpy()))
            raise InputError(
                f"{name}: expected finite numbers, found {table[name].iloc[row]} in row {row + 1}"
            )
    return table.assign(**numbers)


def _check_uncertainty(table: "pd.DataFrame", by: str) -> None:
    """Raises: InputError for a negative standard deviation, or a value outside its interval."""
    sd_name, low_name, high_name = uncertainty_columns(by)
    value = table[by].to_numpy(dtype=float)
    for name, words, bound, sign in (
        (sd_name, "at least 0", np.zeros(len(value)), 1),
        (low_name, f"at most {by}", value, -1),
        (high_name, f"at least {by}", value, 1),
    ):
        if name not in table:
            continue
        found = table[name].to_numpy(dtype=float)
        rows = np.flatnonzero(sign * (found - bound) < 0)
        if len(rows):
            raise InputError(
                f"{name}: expected {words}, found {found[rows[0]]:g} in row {rows[0] + 1}"
            )


def _before_next(value: Floats, sd: Floats) -> Floats:
    """Probability (n,) that each value's truth is above the next one's; NaN for the last."""
    if len(value) == 0:
        return np.empty(0)
    apart = value[:-1] - value[1:]
    both = np.hypot(sd[:-1], sd[1:])
    with np.errstate(divide="ignore", invalid="ignore"):
        over = np.where(both > 0, apart / both, np.where(apart > 0, np.inf, 0.0))
    return np.append(ndtr(over), np.nan)


def _places(value: Floats, sd: Floats) -> tuple[Floats, Floats, Floats]:
    """Ends of the 90 % interval of the rank from 1, and the probability of rank 1, each (n,)."""
    count = len(value)
    if count == 0:
        return np.empty(0), np.empty(0), np.empty(0)
    rng = np.random.default_rng(0)
    at_once = max(1, min(DRAWS, _CELLS // count))
    ranks = []
    for start in range(0, DRAWS, at_once):
        draws = min(at_once, DRAWS - start)
        drawn = value + sd * rng.standard_normal((draws, count))
        place = np.argsort(np.argsort(-drawn, axis=1, kind="stable"), axis=1) + 1
        ranks.append(place.astype(np.int32))
    every = np.concatenate(ranks)
    tail = (1 - COVERAGE) / 2
    low, high = np.quantile(every, [tail, 1 - tail], axis=0, method="nearest")
    return low, high, (every == 1).mean(axis=0)
