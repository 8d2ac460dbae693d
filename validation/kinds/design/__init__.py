"""Designed experiments: which cause moves a rock's value from view to view, and how much."""

from validation.kinds.design.spec import DesignExperiment
from validation.suite.kind import Kind

KIND = Kind(
    name="design",
    spec=DesignExperiment,
    work="validation.kinds.design.work",
    judge="validation.kinds.design.judge",
    page="validation.kinds.design.page",
)
