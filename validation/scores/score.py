"""A score and how it is defined."""

import zlib
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from validation.agreement.interval import bootstrap_interval

BOOTSTRAP_SEED = 20020309


@dataclass(frozen=True)
class Score:
    """A number with its unit, what it was counted over, and its 95 % interval (NaN: none)."""

    name: str
    title: str
    value: float
    unit: str
    count: int
    counted: str
    low: float
    high: float


@dataclass(frozen=True)
class Estimate:
    """A value and its count; with `weighted`, also what a bootstrap over rocks needs."""

    value: float
    count: int
    rocks: int = 0
    weighted: Callable[[NDArray[np.float64]], float] | None = None


@dataclass(frozen=True)
class Definition:
    """How a score is named and computed from records; `compute` has no other input."""

    name: str
    title: str
    unit: str
    counted: str
    compute: Callable[[pd.DataFrame], Estimate]


def estimate(definition: Definition, records: pd.DataFrame) -> Score:
    """Compute a score; the interval's draws depend on the score's name alone."""
    found = definition.compute(records)
    low = high = float("nan")
    if found.weighted is not None:
        rng = np.random.default_rng([BOOTSTRAP_SEED, zlib.crc32(definition.name.encode())])
        low, high = bootstrap_interval(found.weighted, found.rocks, rng=rng)
    return Score(
        name=definition.name,
        title=definition.title,
        value=found.value,
        unit=definition.unit,
        count=found.count,
        counted=definition.counted,
        low=low,
        high=high,
    )
