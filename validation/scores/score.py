"""A score and how it is defined."""

import math
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
import pandas as pd

from validation.scores.titles import REFERENCE
from validation.statistics.interval import Weighted, bootstrap_interval

BOOTSTRAP_SEED = 20020309
VIEW_PREFIX = "view_"  # of statistics against what a view truly shows

Better = Literal["higher", "lower", "neither"]


@dataclass(frozen=True)
class Key:
    """What a score is a score of; empty where it has no such part."""

    experiment: str
    method: str
    series: str
    measure: str
    statistic: str

    @property
    def name(self) -> str:
        """The parts joined by dots; the paper's method is left out."""
        method = "" if self.method == REFERENCE else self.method
        parts = (self.experiment, method, self.series, self.measure, self.statistic)
        return ".".join(part for part in parts if part)


@dataclass(frozen=True)
class Score:
    """A number with its unit, what it was counted over, and its 95 % interval (NaN: none).

    `p` is the chance of such a value without any agreement, where a score has a test.
    """

    key: Key
    title: str
    value: float
    unit: str
    count: int
    counted: str
    better: Better
    low: float
    high: float
    p: float = math.nan

    @property
    def name(self) -> str:
        """The score's name."""
        return self.key.name


@dataclass(frozen=True)
class Estimate:
    """A value and its count, and how its interval is found: given, or by a bootstrap over rocks."""

    value: float
    count: int
    rocks: int = 0
    weighted: Weighted | None = None
    interval: tuple[float, float] | None = None
    p_value: Callable[[], float] | None = None


@dataclass(frozen=True)
class Definition:
    """How a score is named and computed from records; `compute` has no other input."""

    key: Key
    title: str
    unit: str
    counted: str
    better: Better
    compute: Callable[[pd.DataFrame], Estimate]

    @property
    def name(self) -> str:
        """The score's name."""
        return self.key.name


def score_rng(name: str) -> np.random.Generator:
    """Draws of a score's bootstrap, which depend on its name alone."""
    return np.random.default_rng([BOOTSTRAP_SEED, zlib.crc32(name.encode())])


def estimate(definition: Definition, records: pd.DataFrame) -> Score:
    """Compute a score with its interval."""
    found = definition.compute(records)
    low, high = found.interval or (math.nan, math.nan)
    if found.weighted is not None:
        low, high = bootstrap_interval(found.weighted, found.rocks, rng=score_rng(definition.name))
    return Score(
        key=definition.key,
        title=definition.title,
        value=found.value,
        unit=definition.unit,
        count=found.count,
        counted=definition.counted,
        better=definition.better,
        low=low,
        high=high,
        p=math.nan if found.p_value is None else found.p_value(),
    )
