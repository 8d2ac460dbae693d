"""Uncertainty of one rock: standard deviation and 90 % interval of each value."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rockshape.uncertainty.error_model import ErrorModel
from rockshape.uncertainty.observables import Observables

COVERAGE = 0.9


@dataclass(frozen=True)
class Uncertainty:
    """Standard deviation and 90 % interval of a value, in its unit; NaN without a value."""

    sd: float
    low: float
    high: float


_NONE = Uncertainty(float("nan"), float("nan"), float("nan"))


def uncertainty_columns(name: str) -> tuple[str, str, str]:
    """Columns of the standard deviation and both ends of the interval of a column's value."""
    return f"{name}_sd", f"{name}_low", f"{name}_high"


def estimates(
    values: Mapping[str, float],
    observables: Observables,
    models: Mapping[str, ErrorModel],
    ranges: Mapping[str, tuple[float, float]],
) -> dict[str, Uncertainty]:
    """Uncertainties of the values that have a model, by their columns.

    Intervals end where a measure's values end; `ranges` has those ends by column. A rock of which
    more is hidden than of those of the fit has none.
    """
    return {
        name: _estimate(value, observables, models[name], ranges.get(name, (0.0, np.inf)))
        for name, value in values.items()
        if name in models
    }


def _estimate(
    value: float, observables: Observables, model: ErrorModel, ends: tuple[float, float]
) -> Uncertainty:
    if not (np.isfinite(value) and model.knows(observables)):
        return _NONE
    low, high = (float(np.clip(end, *ends)) for end in model.interval(value, observables))
    return Uncertainty(model.deviation(value, observables), low, high)
