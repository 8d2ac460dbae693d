"""Assertion of consistency across views: each rock's value, and the order of rocks."""

from collections import Counter

import numpy as np
import pandas as pd

from validation.errors import InputError
from validation.statistics import Block, between_views, coefficients_of_variation, share_in_order
from validation.testing.tables import ByView, by_view, listed


def assert_consistent(
    values_by_view: ByView, *, cv_at_most: float | None = None, order_at_least: float | None = None
) -> None:
    """Assert that values hold between the views that show the same rocks.

    - values_by_view: (views, rocks), NaN where a view does not show a rock; or one collection of
      numbers a view, by the rocks' keys; or a pandas DataFrame of a row a view, a column a rock.
    - cv_at_most: bound on each rock's coefficient of variation across views, s/x̄ with the sample
      standard deviation (n − 1). A rock that one view shows has none, and is left out.
    - order_at_least: bound on the share of pairs of rocks that two views order alike, 0 to 1. Ties
      in the first of two views are left out, those in the second count one half.

    Raises:
        AssertionError: a bound is missed, or no rock is shown twice; rocks or pairs are named.
        InputError: neither bound is given, or something other than numbers by view and rock.
    """
    __tracebackhide__ = True
    if cv_at_most is None and order_at_least is None:
        raise InputError("assert_consistent: expected cv_at_most or order_at_least, found neither")
    table = by_view(values_by_view)
    if not (np.isfinite(table.to_numpy()).sum(axis=0) > 1).any():
        raise AssertionError(
            f"expected rocks that two views show, found none: {table.shape[1]} rocks in "
            f"{table.shape[0]} views"
        )
    if cv_at_most is not None:
        _assert_steady(table, cv_at_most)
    if order_at_least is not None:
        _assert_ordered_alike(table, order_at_least)


def _assert_steady(table: pd.DataFrame, cv_at_most: float) -> None:
    __tracebackhide__ = True
    cvs = coefficients_of_variation([_block(table)])
    often = np.isfinite(table.to_numpy()).sum(axis=0) > 1
    above = np.flatnonzero(often & ~(cvs <= cv_at_most)).tolist()
    if above:
        worst_first = sorted(above, key=lambda rock: -np.nan_to_num(cvs[rock], nan=np.inf))
        raise AssertionError(
            f"expected a coefficient of variation across views ≤ {cv_at_most:g}, "
            f"found more for {len(above)} of {np.count_nonzero(often)} rocks"
            + listed([_rock_line(table, rock, cvs[rock]) for rock in worst_first])
        )


def _rock_line(table: pd.DataFrame, rock: int, cv: float) -> str:
    column = table.iloc[:, rock]
    values = ", ".join(f"{value:.4g} in view {view}" for view, value in column.dropna().items())
    told = f"{cv:.3f}" if np.isfinite(cv) else "undefined, as the mean is not positive"
    return f"rock {table.columns[rock]}: {told} ({values})"


def _assert_ordered_alike(table: pd.DataFrame, order_at_least: float) -> None:
    __tracebackhide__ = True
    pairs = between_views([_block(table)])
    share = share_in_order(pairs)
    if share >= order_at_least:
        return
    against = pairs.expected * pairs.found < 0
    couples = Counter(zip(pairs.first[against], pairs.second[against], strict=True))
    raise AssertionError(
        f"expected a share of pairs ordered alike by two views ≥ {order_at_least:g}, found "
        f"{f'{share:.3f}' if np.isfinite(share) else 'no pair of rocks that two views show'}"
        + listed(
            [
                f"rocks {table.columns[i]} and {table.columns[j]}: differently in {count} "
                f"{'pair' if count == 1 else 'pairs'} of views"
                for (i, j), count in couples.most_common()
            ]
        )
    )


def _block(table: pd.DataFrame) -> Block:
    return Block(table.to_numpy(dtype=np.float64), np.zeros(table.shape[1]))
