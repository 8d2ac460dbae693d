"""Statistics of weighted values: of each draw of a bootstrap at once.

Weights are (draws, values), a result (draws,): NaN in a draw that took none of the values.
"""

import numpy as np

from validation.arrays import Floats


def ratio(of: Floats, over: Floats) -> Floats:
    """Quotient, NaN where the divisor is not positive."""
    return np.divide(of, over, out=np.full_like(over, np.nan), where=over > 0)


def mean(values: Floats, weights: Floats) -> Floats:
    """Weighted mean."""
    return ratio(weights @ values, weights.sum(axis=1))


def square_sum(values: Floats, weights: Floats) -> Floats:
    """Weighted sum of squared differences from the mean; 0 where they are no more than rounding.

    Values are (values,) or (draws, values).
    """
    moved = values - values[..., :1]  # so that equal ones, however many, leave no rounding
    middle = ratio(np.vecdot(weights, moved), weights.sum(axis=1))
    squares = np.vecdot(weights, (moved - middle[:, None]) ** 2)
    rounding = (8 * np.finfo(np.float64).eps) ** 2 * np.vecdot(weights, values**2)
    return np.where(squares <= rounding, 0.0, squares)


def lower_median(values: Floats, weights: Floats) -> Floats:
    """Least value up to which half of the weight lies."""
    return _middles(values, weights)[0]


def median(values: Floats, weights: Floats) -> Floats:
    """Median of values repeated as often as their weights, whole numbers, say."""
    lower, upper = _middles(values, weights)
    return 0.5 * (lower + upper)


def _middles(values: Floats, weights: Floats) -> tuple[Floats, Floats]:
    """Values at which half of the weight is reached, and passed."""
    order = np.argsort(values, kind="stable")
    ranked = np.append(values[order], np.nan)
    reached = np.cumsum(weights[:, order], axis=1)
    whole = weights.sum(axis=1, keepdims=True)
    lower = np.count_nonzero(reached < 0.5 * whole, axis=1)
    upper = np.count_nonzero(reached <= 0.5 * whole, axis=1)
    return np.where(whole[:, 0] > 0, ranked[lower], np.nan), ranked[upper]
