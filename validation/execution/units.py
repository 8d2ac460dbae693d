"""Work unit: one scene or one drawing, and everything that its result depends on."""

import inspect
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Generic, TypeVar

import pandas as pd

from validation.peers import MeasureSpec, source_digest
from validation.records.pictures import Picture, Portrait
from validation.suite.experiment import Experiment
from validation.suite.plugins import load_plugin
from validation.suite.suite import Suite

E_co = TypeVar("E_co", bound=Experiment, covariant=True)


@dataclass(frozen=True)
class Unit(Generic[E_co]):
    """Scene (or drawing) number `scene` of one series of an experiment."""

    experiment: E_co
    series: str
    scene: int
    measures: tuple[MeasureSpec, ...] = ()  # judged beside the experiment's methods
    plugins: tuple[str, ...] = ()  # modules that register what the experiment names


AnyUnit = Unit[Experiment]


@dataclass(frozen=True, eq=False)
class UnitResult:
    """Result of a unit: its records and pictures."""

    records: pd.DataFrame  # one row a view, method (or way) and rock: true, found or both
    pictures: tuple[Picture, ...]
    backend: str  # the renderer, empty for drawings
    portraits: tuple[Portrait, ...] = ()

    def album(self) -> tuple[Portrait, ...]:
        """Portraits."""
        return self.portraits


def units_of(suite: Suite) -> tuple[AnyUnit, ...]:
    """All units of a suite, in the order of their records."""
    return tuple(
        Unit(
            experiment,
            series,
            scene,
            measures=suite.measures if experiment.takes_measures else (),
            plugins=suite.plugins,
        )
        for experiment in suite.experiments
        for series, scene in experiment.units
    )


def describe(unit: AnyUnit) -> str:
    """Unit's name for the progress."""
    words = (unit.experiment.name, unit.series, str(unit.experiment.seed + unit.scene))
    return " ".join(word for word in words if word)


def spec_of(unit: AnyUnit) -> dict[str, object]:
    """Everything that a unit's result depends on but the code, as plain values."""
    return {
        "experiment": unit.experiment.dependencies(unit.series, unit.scene),
        "unit": (unit.series, unit.scene),
        "measures": [
            {"name": m.name, "function": m.function, "command": m.command}
            | {"source": source_digest(m)}
            for m in unit.measures
        ],
        "plugins": [(plugin, _plugin_digest(plugin)) for plugin in unit.plugins],
    }


@cache
def _plugin_digest(plugin: str) -> str:
    """SHA-256 of the file of a plug-in's module."""
    file = inspect.getsourcefile(load_plugin(plugin))
    return sha256(Path(file).read_bytes()).hexdigest() if file else ""
