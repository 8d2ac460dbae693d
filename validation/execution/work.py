"""Work of a unit: made, measured (or segmented) and matched, a pure function of its spec."""

from importlib import import_module
from typing import Protocol, TypeVar, cast

from validation.execution.measured import ViewCase
from validation.execution.units import AnyUnit, Unit, UnitResult
from validation.suite.experiment import Experiment
from validation.suite.plugins import load_plugin
from validation.suite.registry import kind_of

E_contra = TypeVar("E_contra", bound=Experiment, contravariant=True)


class Work(Protocol[E_contra]):
    """Module of a kind that does its units, in a worker; it imports no scores and no report."""

    def run(self, unit: Unit[E_contra], /) -> UnitResult:
        """Make, measure and match one unit."""


class MeasuredWork(Work[E_contra], Protocol[E_contra]):
    """Work of a kind whose claims are held against measured views, for the mutation bench."""

    def views(self, unit: Unit[E_contra], /) -> tuple[list[ViewCase], str]:
        """Views of a unit and the renderer."""


def work_of(experiment: Experiment) -> Work[Experiment]:
    """Import the work of an experiment's kind."""
    return cast(Work[Experiment], import_module(kind_of(experiment).work))


def run_unit(unit: AnyUnit) -> UnitResult:
    """Make, measure (or segment) and match one unit."""
    for plugin in unit.plugins:
        load_plugin(plugin)
    return work_of(unit.experiment).run(unit)


def views_of(unit: AnyUnit) -> list[ViewCase]:
    """Views of a unit, not yet measured."""
    return cast(MeasuredWork[Experiment], work_of(unit.experiment)).views(unit)[0]
