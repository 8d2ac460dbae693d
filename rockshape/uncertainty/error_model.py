"""Error model of a measure: how far its values lie from the true ones, by a rock's observables."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from types import MappingProxyType

import msgspec
import numpy as np

from rockshape.uncertainty.observables import NAMES, Observables

FILE = "error_model.json"


@dataclass(frozen=True)
class ErrorModel:
    """Middle and scale of a measure's errors, and quantiles of what is left over that scale.

    Of a rock's features f, each held within the range that the fit has seen, the middle is
    shift · f and the scale exp(coefficients · f). With `relative` the errors are of the value's
    logarithm. `python -m training.uncertainty` fits them to made rocks.
    """

    coefficients: tuple[float, ...]
    shift: tuple[float, ...]
    least: tuple[float, ...]  # of each feature in the fit
    most: tuple[float, ...]
    low: float  # 5 % quantile of (value - truth - middle) over the scale
    high: float  # 95 % quantile
    sd: float  # root mean square of the middle 98 % of them
    relative: bool = False

    def middle_and_scale(self, observables: Observables) -> tuple[float, float]:
        """Middle and scale of the error for a rock."""
        features = np.clip(observables.features(), self.least, self.most)
        return float(features @ self.shift), float(np.exp(features @ self.coefficients))

    def interval(self, value: float, observables: Observables) -> tuple[float, float]:
        """Low and high end of the 90 % interval of the true value; the value lies within."""
        middle, scale = self.middle_and_scale(observables)
        over, under = max(middle + scale * self.high, 0.0), min(middle + scale * self.low, 0.0)
        if self.relative:
            return value * float(np.exp(-over)), value * float(np.exp(-under))
        return value - over, value - under

    def deviation(self, value: float, observables: Observables) -> float:
        """Root mean square of the error."""
        middle, scale = self.middle_and_scale(observables)
        sd = float(np.hypot(middle, scale * self.sd))
        return abs(value) * sd if self.relative else sd


class _File(msgspec.Struct):
    """Content of the file."""

    features: tuple[str, ...]
    models: dict[str, ErrorModel]


@cache
def read_error_model() -> Mapping[str, ErrorModel]:
    """Error models of the package, by the columns of measures and axes."""
    told = msgspec.json.decode((files(__package__) / FILE).read_bytes(), type=_File)
    if told.features != NAMES:
        raise ValueError(f"{FILE}: expected the features {NAMES}, found {told.features}")
    return MappingProxyType(told.models)
