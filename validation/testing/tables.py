"""Numbers by rock and by view as tables, and lists of them in a failure's message."""

from collections.abc import Hashable, Iterable, Mapping, Sequence

import pandas as pd
from numpy.typing import ArrayLike

from validation.errors import InputError

ByRock = ArrayLike | Mapping[Hashable, float] | pd.Series
ByView = Iterable[ByRock] | Mapping[Hashable, ByRock] | pd.DataFrame
MAX_LISTED = 10


def by_rock(values: ByRock, *, what: str) -> "pd.Series[float]":
    """Numbers indexed by rock: by the keys of a mapping or a series, else counted from 0.

    Raises:
        InputError: something other than one number a rock.
    """
    try:
        series: pd.Series[float] = pd.Series(values).astype("float64")
    except (TypeError, ValueError) as error:
        raise InputError(f"{what}: expected one number a rock, found: {error}") from error
    if not series.index.is_unique:
        twice = series.index[series.index.duplicated()][0]
        raise InputError(f"{what}: expected each rock once, found {twice} again")
    return series


def by_view(values_by_view: ByView) -> pd.DataFrame:
    """Numbers with a row a view and a column a rock, NaN where a view does not show a rock.

    Raises:
        InputError: something other than one number a rock in each view.
    """
    if isinstance(values_by_view, pd.DataFrame):
        named: Mapping[Hashable, ByRock] = dict(values_by_view.iterrows())
    elif isinstance(values_by_view, Mapping):
        named = values_by_view
    else:
        named = dict(enumerate(values_by_view))
    rows = {view: by_rock(values, what=f"view {view}") for view, values in named.items()}
    return pd.DataFrame(rows).T


def listed(lines: Sequence[str]) -> str:
    """Lines below a message, the first ones where there are many."""
    rest = len(lines) - MAX_LISTED
    more = [f"and {rest} more"] if rest > 0 else []
    return "".join(f"\n  {line}" for line in [*lines[:MAX_LISTED], *more])
