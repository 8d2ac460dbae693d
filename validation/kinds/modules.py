"""Modules of a kind's folder, as types: each `__init__` holds its own modules to them."""

from typing import TypeVar

from validation.execution.work import MeasuredWork, Work
from validation.report.section import Page
from validation.scores.judge import Judge
from validation.suite.experiment import Experiment

E = TypeVar("E", bound=Experiment)

Modules = tuple[Work[E], Judge[E], Page[E]]
MeasuredModules = tuple[MeasuredWork[E], Judge[E], Page[E]]
