"""Fit of error models: scale by the observables, quantiles on families left out."""

from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.optimize import minimize

from rockshape.measurement import AXES
from rockshape.numerics.arrays import Floats
from rockshape.uncertainty import COVERAGE, ErrorModel, ErrorModels
from rockshape.uncertainty.error_model import HIDDEN
from rockshape.uncertainty.observables import NAMES
from training.uncertainty.table import observables_of

LEFT_OUT = Path(__file__).parents[2] / "benchmarks" / "uncertainty_left_out.json"
FEWEST = 100  # errors, below which a value gets no model
OUTER = 0.02  # quantile at which features are held, but for the hidden share's upper end
# power of a value in which its errors add, where it is not the value's own: root mean squares, to
# which the pixels add theirs, and axes, which have logarithms
POWERS = {"ellipse_error": 2, "angularity_2d": 2} | dict.fromkeys(AXES, 0)
_FLOOR = 0.05  # of the median value, below which the scale falls no further
_RIDGE = 1e-3
_ROUND = 0.02  # of the mean error, below which the scale falls no further
_ROUNDS = 200
_WIDENING = ("noise", "hidden")  # features that make no value surer


class Errors(NamedTuple):
    """Errors of a value's power, n of them, with what they depend on."""

    error: Floats  # (n,)
    features: Floats  # (n, k)
    family: NDArray[np.object_]  # (n,)

    def where(self, chosen: NDArray[np.bool_]) -> "Errors":
        """Those that are chosen, (n,)."""
        return Errors(self.error[chosen], self.features[chosen], self.family[chosen])


class Solution(NamedTuple):
    """Scale of errors by features, and the ends within which features are held."""

    coefficients: Floats
    least: Floats
    most: Floats

    def over(self, errors: Errors) -> Floats:
        """Errors (n,) over their scale."""
        held = np.clip(errors.features, self.least, self.most)
        return np.asarray(errors.error / np.exp(held @ self.coefficients))


def fit_models(pairs: pd.DataFrame) -> ErrorModels:
    """Error models of rocks whose outlines are given, and of those that are found."""
    found = pairs["seen_found"].to_numpy(dtype=bool)
    return ErrorModels(given=fit_by_value(pairs[~found]), found=fit_by_value(pairs[found]))


def fit_by_value(pairs: pd.DataFrame) -> dict[str, ErrorModel]:
    """Error model of each value that has errors enough.

    The scale is that of a Laplace distribution of greatest likelihood on all rows. The interval's
    ends are quantiles of errors over the scale, each row's fitted to the other families: they
    cover what the fit does not explain of a family that it has not seen.
    Source: Dunn, Wasserman and Ramdas (2023), Distribution-free prediction sets for two-layer
    hierarchical models.
    """
    models = {}
    for name in value_names(pairs):
        known = known_pairs(pairs, name)
        if len(known) < FEWEST:
            continue
        floor = _short(_FLOOR * float(known[f"value_{name}"].median()))
        blank = _blank(POWERS.get(name, 1), floor)
        errors = errors_of(known, name, blank)
        solution = _fit(errors)
        over = np.sort(_left_out(errors))
        tail = (1 - COVERAGE) / 2
        rank = max(int(np.floor((len(over) + 1) * tail)), 1)
        inner = over[np.abs(over) <= np.quantile(np.abs(over), 0.98)]
        models[name] = ErrorModel(
            coefficients=_numbers(solution.coefficients),
            least=_numbers(solution.least),
            most=_numbers(solution.most),
            low=_short(over[rank - 1]),
            high=_short(over[-rank]),
            sd=_short(np.sqrt(np.mean(inner**2))),
            power=blank.power,
            floor=floor,
        )
    return models


def left_out_models(pairs: pd.DataFrame) -> dict[str, ErrorModels]:
    """Error models by family, fitted to all others."""
    return {own: fit_models(pairs[pairs["family"] != own]) for own in pairs["family"].unique()}


def value_names(table: pd.DataFrame) -> list[str]:
    """Columns of the values in a table of pairs, without `value_`."""
    return [name.removeprefix("value_") for name in map(str, table) if name.startswith("value_")]


def known_pairs(table: pd.DataFrame, name: str) -> pd.DataFrame:
    """Rows of a table of pairs where both a value and its truth are known."""
    return table[np.isfinite(table[f"value_{name}"]) & np.isfinite(table[f"truth_{name}"])]


def errors_of(known: pd.DataFrame, name: str, model: ErrorModel) -> Errors:
    """Errors of a value in the power of its model, from rows that know both it and its truth."""
    value, truth = known[f"value_{name}"].to_numpy(), known[f"truth_{name}"].to_numpy()
    rows = [
        model.features(one, seen) for one, seen in zip(value, observables_of(known), strict=True)
    ]
    return Errors(
        error=model.powered(value) - model.powered(truth),
        features=np.array(rows).reshape(-1, len(NAMES)),
        family=known["family"].to_numpy(dtype=object),
    )


def _blank(power: int, floor: float) -> ErrorModel:
    """Model before its fit."""
    none = (0.0,) * len(NAMES)
    return ErrorModel(none, none, none, low=0.0, high=0.0, sd=0.0, power=power, floor=floor)


def _left_out(errors: Errors) -> Floats:
    """Errors (n,) over their scale, each by the fit to all other families."""
    over = np.empty_like(errors.error)
    for own in np.unique(errors.family):
        left = errors.family == own
        over[left] = _fit(errors.where(~left)).over(errors.where(left))
    return over


def _fit(errors: Errors) -> Solution:
    """Scale of greatest likelihood, drawn a little towards one for all rocks.

    It never falls as noise or what is hidden grows.
    """
    error, features = errors.error, errors.features
    least, most = np.quantile(features, [OUTER, 1 - OUTER], axis=0)
    most[HIDDEN] = features[:, HIDDEN].max()  # beyond which no interval is given
    held = np.clip(features, least, most)
    mean, spread = held.mean(axis=0), held.std(axis=0)
    mean[0], spread[spread == 0] = 0.0, 1.0
    even = (held - mean) / spread
    size = float(np.mean(np.abs(error)))
    loss = np.hypot(error / size, _ROUND)

    def cost(solution: Floats) -> tuple[float, Floats]:
        level = even @ solution
        over = loss * np.exp(-level)
        pull = _RIDGE * solution
        pull[0] = 0.0
        slope = (1 - over) @ even / len(error)
        return float(np.mean(level + over) + pull @ solution / 2), slope + pull

    start = np.zeros(features.shape[1])
    bounds = [(0.0 if name in _WIDENING else None, None) for name in NAMES]
    found = minimize(
        cost, start, jac=True, method="L-BFGS-B", bounds=bounds, options={"maxiter": _ROUNDS}
    ).x
    coefficients = found / spread
    coefficients[0] += np.log(size) - coefficients[1:] @ mean[1:]
    return Solution(coefficients, least, most)


def _numbers(every: Floats) -> tuple[float, ...]:
    return tuple(map(_short, every.tolist()))


def _short(number: float) -> float:
    """Number of five digits, as the file has them."""
    return float(f"{number:.5g}")


def as_json(models: ErrorModels) -> dict[str, object]:
    """Content of the package's file."""
    return {"features": list(NAMES), "given": _plain(models.given), "found": _plain(models.found)}


def _plain(models: Mapping[str, ErrorModel]) -> dict[str, object]:
    return {name: dict(vars(model)) for name, model in models.items()}
