"""Fit of error models: middle and scale by the observables, quantiles on families left out."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.optimize import minimize

from rockshape.measurement import AXES
from rockshape.numerics.arrays import Floats
from rockshape.uncertainty import COVERAGE, ErrorModel
from rockshape.uncertainty.observables import NAMES
from training.uncertainty.table import observables_of

FEWEST = 100  # errors, below which a value gets no model
OUTER = 0.02  # quantile at which features are held
_RIDGE = 1e-3
_ROUND = 0.05  # of the scale, within which an error's loss is round
_ROUNDS = 200


class Solution(NamedTuple):
    """Middle and scale of errors by features, and the ends within which features are held."""

    coefficients: Floats
    shift: Floats
    least: Floats
    most: Floats

    def over(self, error: Floats, features: Floats) -> Floats:
        """Errors (n,) less their middle, over their scale."""
        held = np.clip(features, self.least, self.most)
        return np.asarray((error - held @ self.shift) / np.exp(held @ self.coefficients))


def fit_models(pairs: pd.DataFrame) -> dict[str, ErrorModel]:
    """Error model of each value that has errors enough.

    Middle and scale are those of a Laplace distribution of greatest likelihood on all rows. The
    interval's ends are quantiles of errors over the scale, each row's fitted to the other
    families: they cover what the fit does not explain of a family that it has not seen.
    Source: Dunn, Wasserman and Ramdas (2023), Distribution-free prediction sets for two-layer
    hierarchical models.
    """
    models = {}
    for name in value_names(pairs):
        relative = name in AXES
        error, features, family = errors(pairs, name, relative=relative)
        if len(error) < FEWEST:
            continue
        solution = _fit(error, features)
        over = np.sort(_left_out(error, features, family))
        tail = (1 - COVERAGE) / 2
        rank = max(int(np.floor((len(over) + 1) * tail)), 1)
        inner = over[np.abs(over) <= np.quantile(np.abs(over), 0.98)]
        models[name] = ErrorModel(
            coefficients=_numbers(solution.coefficients),
            shift=_numbers(solution.shift),
            least=_numbers(solution.least),
            most=_numbers(solution.most),
            low=_short(over[rank - 1]),
            high=_short(over[-rank]),
            sd=_short(np.sqrt(np.mean(inner**2))),
            relative=relative,
        )
    return models


def value_names(table: pd.DataFrame) -> list[str]:
    """Columns of the values in a table of pairs, without `value_`."""
    return [name.removeprefix("value_") for name in map(str, table) if name.startswith("value_")]


def errors(
    table: pd.DataFrame, name: str, *, relative: bool
) -> tuple[Floats, Floats, NDArray[np.object_]]:
    """Errors (n,) of a value where both it and its truth are known, features (n, k), families."""
    value, truth = table[f"value_{name}"].to_numpy(), table[f"truth_{name}"].to_numpy()
    known = np.isfinite(value) & np.isfinite(truth)
    value, truth = value[known], truth[known]
    error = np.log(value / truth) if relative else value - truth
    return error, features_of(table[known]), table["family"].to_numpy(dtype=object)[known]


def features_of(table: pd.DataFrame) -> Floats:
    """Features (n, k) of the rocks of a table of pairs."""
    rows = [seen.features() for seen in observables_of(table)]
    return np.array(rows).reshape(-1, len(NAMES))


def _left_out(error: Floats, features: Floats, family: NDArray[np.object_]) -> Floats:
    """Errors (n,) over their scale, each by the fit to all other families."""
    over = np.empty_like(error)
    for own in np.unique(family):
        left = family == own
        over[left] = _fit(error[~left], features[~left]).over(error[left], features[left])
    return over


def _fit(error: Floats, features: Floats) -> Solution:
    """Middle and scale of greatest likelihood, each drawn a little towards one for all rocks."""
    least, most = np.quantile(features, [OUTER, 1 - OUTER], axis=0)
    held = np.clip(features, least, most)
    mean, spread = held.mean(axis=0), held.std(axis=0)
    mean[0], spread[spread == 0] = 0.0, 1.0
    even = (held - mean) / spread
    size = max(float(np.median(np.abs(error))), 1e-9)
    count = features.shape[1]

    def cost(solution: Floats) -> tuple[float, Floats]:
        level, middle = even @ solution[:count], even @ solution[count:]
        over = (error / size - middle) * np.exp(-level)
        loss = np.hypot(over, _ROUND)
        slope = over / loss
        pull = _RIDGE * solution
        pull[0] = 0.0
        by_level = (1 - slope * over) @ even / len(error)
        by_middle = -(slope * np.exp(-level)) @ even / len(error)
        value = np.mean(level + loss) + pull @ solution / 2
        return float(value), np.concatenate([by_level, by_middle]) + pull

    found = minimize(
        cost, np.zeros(2 * count), jac=True, method="L-BFGS-B", options={"maxiter": _ROUNDS}
    ).x
    coefficients, shift = found[:count] / spread, size * found[count:] / spread
    coefficients[0] += np.log(size) - coefficients[1:] @ mean[1:]
    shift[0] -= shift[1:] @ mean[1:]
    return Solution(coefficients, shift, least, most)


def _numbers(every: Floats) -> tuple[float, ...]:
    return tuple(map(_short, every.tolist()))


def _short(number: float) -> float:
    """Number of five digits, as the file has them."""
    return float(f"{number:.5g}")


def as_json(models: Mapping[str, ErrorModel]) -> dict[str, object]:
    """Content of the package's file."""
    return {
        "features": list(NAMES),
        "models": {name: dict(vars(model)) for name, model in models.items()},
    }
