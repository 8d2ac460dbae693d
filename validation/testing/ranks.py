"""Assertion of rank agreement with a truth, by Kendall's τ_b."""

import numpy as np
import pandas as pd

from validation.errors import InputError
from validation.statistics import Block, Pairs, tau_b, within_views
from validation.testing.tables import ByRock, by_rock, listed

_SIGN = {-1: "<", 0: "=", 1: ">"}


def assert_ranks(
    values: ByRock, truth: ByRock, at_least: float = 0.8, *, allow_missing: bool = False
) -> None:
    """Assert that values order rocks as the truth does: Kendall's τ_b reaches a bound.

    - values, truth: one number a rock, in one order (rocks,), or by the same keys (a mapping or a
      pandas Series), by which a failure then names the rocks. Negate what should fall with the
      truth.
    - at_least: bound on τ_b, −1 to 1.
    - allow_missing: leave out rocks whose value or truth is NaN, instead of failing.

    Raises:
        AssertionError: τ_b is below the bound or undefined, or a number is missing; pairs out of
            order are listed, those farthest apart in truth first.
        InputError: values and truth are not one number a rock, or not of the same rocks.

    Source: Kendall (1945), "The treatment of ties in ranking problems".
    """
    __tracebackhide__ = True
    rocks = _side_by_side(by_rock(values, what="values"), by_rock(truth, what="truth"))
    known = np.isfinite(rocks.to_numpy()).all(axis=1)
    if not known.all() and not allow_missing:
        raise AssertionError(
            f"expected a value and a truth of each of {len(rocks)} rocks, found one missing of"
            + listed([_row(rocks, index) for index in np.flatnonzero(~known).tolist()])
        )
    rocks = rocks[known]
    pairs = within_views([Block(rocks["value"].to_numpy()[None], rocks["truth"].to_numpy())])
    tau = tau_b(pairs)
    if tau >= at_least:
        return
    undefined = "none, as all values or all truths are equal"
    wrong = _misordered(pairs, rocks)
    raise AssertionError(
        f"expected Kendall's τ_b ≥ {at_least:g}, found "
        f"{f'{tau:.3f}' if np.isfinite(tau) else undefined}: of {pairs.decided} pairs of "
        f"{len(rocks)} rocks {len(wrong)} are out of order{listed(wrong)}"
    )


def _side_by_side(values: "pd.Series[float]", truth: "pd.Series[float]") -> pd.DataFrame:
    if set(values.index) != set(truth.index):
        unpaired = sorted(map(str, values.index.symmetric_difference(truth.index)))
        raise InputError(
            f"assert_ranks: expected values and truth of the same rocks, found {len(values)} and "
            f"{len(truth)}, and in one alone {', '.join(unpaired)}"
        )
    return pd.DataFrame({"value": values, "truth": truth.reindex(values.index)})


def _row(rocks: pd.DataFrame, index: int) -> str:
    row = rocks.iloc[index]
    return f"rock {rocks.index[index]}: value {row['value']:.4g}, truth {row['truth']:.4g}"


def _misordered(pairs: Pairs, rocks: pd.DataFrame) -> list[str]:
    """Lines on the pairs that values do not order as the truth does, ties among them."""
    value, truth = rocks["value"].to_numpy(), rocks["truth"].to_numpy()
    wrong = (pairs.expected != 0) & (pairs.expected != pairs.found)
    couples = list(zip(pairs.first[wrong], pairs.second[wrong], strict=True))
    lines = []
    for couple in sorted(couples, key=lambda pair: -abs(truth[pair[0]] - truth[pair[1]])):
        low, high = sorted(couple, key=lambda rock: truth[rock])
        sign = _SIGN[int(np.sign(value[low] - value[high]))]
        lines.append(
            f"rocks {rocks.index[low]} and {rocks.index[high]}: "
            f"truth {truth[low]:.4g} < {truth[high]:.4g}, "
            f"but values {value[low]:.4g} {sign} {value[high]:.4g}"
        )
    return lines
