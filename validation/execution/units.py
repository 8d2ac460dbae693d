"""Work units: one scene or one drawing, and all that its result depends on."""

from dataclasses import dataclass

import msgspec
import pandas as pd

from validation.peers import MeasureSpec, source_digest
from validation.records.pictures import Picture, Portrait
from validation.suite.experiments import (
    DesignExperiment,
    SegmentationExperiment,
    ShapesExperiment,
    YardExperiment,
)
from validation.suite.suite import Suite


@dataclass(frozen=True)
class SceneUnit:
    """Scene number `scene` of an experiment of rocks, at one step of its sweep."""

    experiment: YardExperiment
    series: str
    scene: int
    measures: tuple[MeasureSpec, ...] = ()  # beside the experiment's methods


@dataclass(frozen=True)
class DrawingUnit:
    """Drawing number `scene` of one series of an experiment of shapes."""

    experiment: ShapesExperiment
    series: str
    scene: int
    measures: tuple[MeasureSpec, ...] = ()


@dataclass(frozen=True)
class SegmentationUnit:
    """Scene number `scene` of an experiment of segmentation."""

    experiment: SegmentationExperiment
    scene: int


@dataclass(frozen=True)
class DesignUnit:
    """Scene number `scene` of a designed experiment, in all its cells."""

    experiment: DesignExperiment
    scene: int


MeasuredUnit = SceneUnit | DrawingUnit
Unit = MeasuredUnit | SegmentationUnit | DesignUnit


@dataclass(frozen=True, eq=False)
class UnitResult:
    """What became of a unit."""

    records: pd.DataFrame  # one row a view, method (or way) and rock: true, found or both
    pictures: tuple[Picture, ...]
    backend: str  # the renderer, empty for drawings
    portraits: tuple[Portrait, ...] = ()

    def album(self) -> tuple[Portrait, ...]:
        """Return the portraits."""
        return self.portraits


def units_of(suite: Suite) -> tuple[Unit, ...]:
    """Return all units of a suite, in the order of their records."""
    units: list[Unit] = []
    for experiment in suite.experiments:
        if isinstance(experiment, YardExperiment):
            units += [
                SceneUnit(experiment, step, scene, suite.measures)
                for step in experiment.series
                for scene in range(experiment.scenes)
            ]
        elif isinstance(experiment, SegmentationExperiment):
            units += [SegmentationUnit(experiment, scene) for scene in range(experiment.scenes)]
        elif isinstance(experiment, DesignExperiment):
            units += [DesignUnit(experiment, scene) for scene in range(experiment.scenes)]
        else:
            units += [
                DrawingUnit(experiment, series, drawing, suite.measures)
                for series in experiment.series
                for drawing in range(experiment.drawings)
            ]
    return tuple(units)


def describe(unit: Unit) -> str:
    """Return a unit's name for the progress."""
    series = unit.series if isinstance(unit, MeasuredUnit) else ""
    words = (unit.experiment.name, series, str(unit.experiment.seed + unit.scene))
    return " ".join(word for word in words if word)


def spec_of(unit: Unit) -> dict[str, object]:
    """Return all that a unit's result depends on but the code, as plain values.

    How many scenes there are, what they vary and what they are called is of no account.
    """
    spec: dict[str, object] = msgspec.to_builtins(unit.experiment)
    for name in ("title", "scenes", "drawings", "varied", "pictured"):
        spec.pop(name, None)
    spec |= {
        "scene_number": unit.scene,
        "pictured": is_pictured(unit),
        "portrayed": is_portrayed(unit),
    }
    if isinstance(unit, SegmentationUnit | DesignUnit):
        return spec
    spec["measures"] = [
        {"name": m.name, "function": m.function, "command": m.command, "source": source_digest(m)}
        for m in unit.measures
    ]
    spec["series"] = unit.series
    if isinstance(unit, SceneUnit):
        spec["scene"] = msgspec.to_builtins(unit.experiment.scene_at(unit.series))
        spec.pop("sweep")
    return spec


def is_pictured(unit: Unit) -> bool:
    """Whether the unit's whole views are kept."""
    if isinstance(unit, DesignUnit):
        return False
    return unit.scene < (1 if isinstance(unit, DrawingUnit) else unit.experiment.pictured)


def is_portrayed(unit: Unit) -> bool:
    """Whether each rock's portrait is kept: not where no scene is to be pictured."""
    if isinstance(unit, SegmentationUnit | DesignUnit):
        return False
    return isinstance(unit, DrawingUnit) or unit.experiment.pictured > 0
