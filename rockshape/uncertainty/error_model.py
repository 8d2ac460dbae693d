"""Error model of a measure: how far its values lie from the true ones, by a rock's observables."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from types import MappingProxyType

import msgspec
import numpy as np

from rockshape.numerics.arrays import Floats
from rockshape.uncertainty.observables import NAMES, Observables

FILE = "error_model.json"
HIDDEN = NAMES.index("hidden")


@dataclass(frozen=True)
class ErrorModel:
    """Scale of a measure's errors, and quantiles of the errors over that scale.

    Errors are those of a power of the value, of that in which they add: the square of a root mean
    square, say, or the logarithm where the power is 0. So the low end of an interval falls to 0 as
    the value comes near what noise alone gives. Of a rock's features f, each held within the range
    that the fit has seen, the scale is exp(coefficients · f). `python -m training.uncertainty` fits
    them to made rocks.
    """

    coefficients: tuple[float, ...]
    least: tuple[float, ...]  # of each feature in the fit
    most: tuple[float, ...]
    low: float  # 5 % quantile of (value^power - truth^power) over the scale
    high: float  # 95 % quantile
    sd: float  # root mean square of the middle 98 % of them
    power: int  # 0: the logarithm
    floor: float  # value below which the scale falls no further

    def features(self, value: float, observables: Observables) -> Floats:
        """Features of a value's error, before they are held within those of the fit."""
        level = float(np.log(np.hypot(value, self.floor))) if self.power else 0.0
        return observables.features(level)

    def scale(self, value: float, observables: Observables) -> float:
        """Scale of the error for a rock."""
        held = np.clip(self.features(value, observables), self.least, self.most)
        return float(np.exp(held @ self.coefficients))

    def knows(self, observables: Observables) -> bool:
        """Whether no more of a rock is hidden than of those of the fit."""
        return bool(observables.features(0.0)[HIDDEN] <= self.most[HIDDEN])

    def interval(self, value: float, observables: Observables) -> tuple[float, float]:
        """Low and high end of the 90 % interval of the true value; the value lies within."""
        scale = self.scale(value, observables)
        low = self._moved(value, -scale * max(self.high, 0.0))  # the value errs upwards
        high = self._moved(value, -scale * min(self.low, 0.0))
        return low, high

    def deviation(self, value: float, observables: Observables) -> float:
        """Standard deviation: half of what one of the power spans, up and down from the value."""
        step = self.scale(value, observables) * self.sd
        return (self._moved(value, step) - self._moved(value, -step)) / 2.0

    def powered(self, values: Floats) -> Floats:
        """Values, none below 0, in the power in which their errors add."""
        return np.asarray(np.log(values) if self.power == 0 else values**self.power)

    def _moved(self, value: float, step: float) -> float:
        """Value, from 0, whose power is a step farther than that of another."""
        if self.power == 0:
            return value * float(np.exp(step))
        return float(max(value**self.power + step, 0.0) ** (1.0 / self.power))


@dataclass(frozen=True)
class ErrorModels:
    """Error models by the columns of measures and axes, for both kinds of outline."""

    # of outlines that labels give, taken to be right, and of those that a finder drew
    given: Mapping[str, ErrorModel] = field(default_factory=dict)
    found: Mapping[str, ErrorModel] = field(default_factory=dict)

    def of(self, observables: Observables) -> Mapping[str, ErrorModel]:
        """Models for a rock's kind of outline."""
        return self.found if observables.found else self.given


class _File(msgspec.Struct):
    """Content of the file."""

    features: tuple[str, ...]
    given: dict[str, ErrorModel]
    found: dict[str, ErrorModel]


@cache
def read_error_models() -> ErrorModels:
    """Error models of the package."""
    return decode_models((files(__package__) / FILE).read_bytes(), where=FILE)


def decode_models(content: bytes, *, where: str) -> ErrorModels:
    """Error models from the content of a file that `python -m training.uncertainty` wrote.

    Raises: ValueError for models of other features.
    """
    told = msgspec.json.decode(content, type=_File)
    if told.features != NAMES:
        raise ValueError(f"{where}: expected the features {NAMES}, found {told.features}")
    return ErrorModels(MappingProxyType(told.given), MappingProxyType(told.found))
