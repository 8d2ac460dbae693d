"""Fit of error models: a scale by the observables, then quantiles on rocks of other seeds."""

from collections.abc import Mapping

import numpy as np
import pandas as pd
from scipy.optimize import minimize

from rockshape.measurement import AXES
from rockshape.numerics.arrays import Floats
from rockshape.uncertainty import COVERAGE, ErrorModel
from rockshape.uncertainty.observables import NAMES
from training.uncertainty.table import observables_of

FEWEST = 100  # errors, below which a value gets no model
_RIDGE = 1e-3
_LEAST = 1e-6  # error


def fit_models(fitted: pd.DataFrame, calibrated: pd.DataFrame) -> dict[str, ErrorModel]:
    """Error model of each value that has errors enough.

    The scale is that of a Laplace distribution of greatest likelihood on the first table; the
    interval's ends are conformal quantiles of the second table's errors over that scale, so that
    they cover what the scale does not explain.
    """
    models = {}
    for name in value_names(fitted):
        relative = name in AXES
        error, features = errors(fitted, name, relative=relative)
        if len(error) < FEWEST:
            continue
        coefficients = _fit_scale(error, features)
        error, features = errors(calibrated, name, relative=relative)
        if len(error) < FEWEST:
            continue
        over = np.sort(error / np.exp(features @ coefficients))
        tail = (1 - COVERAGE) / 2
        rank = max(int(np.floor((len(over) + 1) * tail)), 1)
        inner = over[np.abs(over) <= np.quantile(np.abs(over), 0.98)]
        models[name] = ErrorModel(
            coefficients=tuple(coefficients.round(4).tolist()),
            low=round(float(over[rank - 1]), 4),
            high=round(float(over[-rank]), 4),
            sd=round(float(np.sqrt(np.mean(inner**2))), 4),
            relative=relative,
        )
    return models


def value_names(table: pd.DataFrame) -> list[str]:
    """Columns of the values in a table of pairs, without `value_`."""
    return [name.removeprefix("value_") for name in map(str, table) if name.startswith("value_")]


def errors(table: pd.DataFrame, name: str, *, relative: bool) -> tuple[Floats, Floats]:
    """Errors (n,) of a value where both it and its truth are known, and features (n, k)."""
    value, truth = table[f"value_{name}"].to_numpy(), table[f"truth_{name}"].to_numpy()
    known = np.isfinite(value) & np.isfinite(truth)
    value, truth = value[known], truth[known]
    error = np.log(value / truth) if relative else value - truth
    return error, features_of(table[known])


def features_of(table: pd.DataFrame) -> Floats:
    """Features (n, k) of the rocks of a table of pairs."""
    rows = [seen.features() for seen in observables_of(table)]
    return np.array(rows).reshape(-1, len(NAMES))


def _fit_scale(error: Floats, features: Floats) -> Floats:
    size = np.maximum(np.abs(error), _LEAST)

    def cost(solution: Floats) -> tuple[float, Floats]:
        level = features @ solution
        over = size * np.exp(-level)
        slope = (1 - over) @ features / len(size)
        pull = _RIDGE * np.concatenate([[0.0], solution[1:]])
        return float(np.mean(level + over) + pull @ solution / 2), slope + pull

    start = np.zeros(features.shape[1])
    start[0] = np.log(size.mean())
    return np.asarray(minimize(cost, start, jac=True, method="L-BFGS-B").x)


def as_json(models: Mapping[str, ErrorModel]) -> dict[str, object]:
    """Content of the package's file."""
    return {
        "features": list(NAMES),
        "models": {name: dict(vars(model)) for name, model in models.items()},
    }
