"""Estimates of one rock: each value with its standard deviation and 90 % interval."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rockshape.uncertainty.error_model import ErrorModel
from rockshape.uncertainty.observables import Observables

COVERAGE = 0.9


@dataclass(frozen=True)
class Estimate:
    """Standard deviation and 90 % interval of a value, in its unit; NaN without a value."""

    sd: float
    low: float
    high: float


_NONE = Estimate(float("nan"), float("nan"), float("nan"))


def uncertainty_columns(name: str) -> tuple[str, str, str]:
    """Columns of the standard deviation and both ends of the interval of a column's value."""
    return f"{name}_sd", f"{name}_low", f"{name}_high"


def estimates(
    values: Mapping[str, float],
    observables: Observables,
    models: Mapping[str, ErrorModel],
    ranges: Mapping[str, tuple[float, float]],
) -> dict[str, Estimate]:
    """Estimates of the values that have a model, by their columns.

    Intervals end where a measure's values end; `ranges` has those ends by column.
    """
    return {
        name: _estimate(value, observables, models[name], ranges.get(name, (0.0, np.inf)))
        for name, value in values.items()
        if name in models
    }


def _estimate(
    value: float, observables: Observables, model: ErrorModel, ends: tuple[float, float]
) -> Estimate:
    if not np.isfinite(value):
        return _NONE
    low, high = (float(np.clip(end, *ends)) for end in model.interval(value, observables))
    return Estimate(model.deviation(value, observables), low, high)
