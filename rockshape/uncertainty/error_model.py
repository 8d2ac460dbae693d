"""Error model of a measure: how far its values lie from the true ones, by a rock's observables."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType

import numpy as np

from rockshape.uncertainty.observables import NAMES, Observables

FILE = "error_model.json"
_MOST = 6.0  # logarithm of the scale over that at the middle of the features


@dataclass(frozen=True)
class ErrorModel:
    """Scale of a measure's errors and the quantiles of its errors over that scale.

    The scale is exp(coefficients · features). With `relative` the errors are of the value's
    logarithm. `python -m training.uncertainty` fits them to made rocks.
    """

    coefficients: tuple[float, ...]
    low: float  # 5 % quantile of (value - truth) over the scale
    high: float  # 95 % quantile
    sd: float  # root mean square of the middle 98 % of them
    relative: bool = False

    def scale(self, observables: Observables) -> float:
        """Scale of the error for a rock."""
        level = float(np.dot(self.coefficients, observables.features()))
        return float(np.exp(np.clip(level, self.coefficients[0] - _MOST, _MOST)))

    def interval(self, value: float, observables: Observables) -> tuple[float, float]:
        """Low and high end of the 90 % interval of the true value."""
        scale = self.scale(observables)
        low, high = scale * self.high, scale * self.low
        if self.relative:
            return value * float(np.exp(-low)), value * float(np.exp(-high))
        return value - low, value - high

    def deviation(self, value: float, observables: Observables) -> float:
        """Standard deviation of the error."""
        sd = self.scale(observables) * self.sd
        return abs(value) * sd if self.relative else sd


@cache
def read_error_model() -> Mapping[str, ErrorModel]:
    """Error models of the package, by the columns of measures and axes."""
    told = json.loads((files(__package__) / FILE).read_text(encoding="utf-8"))
    if tuple(told["features"]) != NAMES:
        raise ValueError(f"{FILE}: expected the features {NAMES}, found {told['features']}")
    return MappingProxyType(
        {
            name: ErrorModel(**{**model, "coefficients": tuple(model["coefficients"])})
            for name, model in told["models"].items()
        }
    )
