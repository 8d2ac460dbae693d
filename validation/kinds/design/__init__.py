"""Designed experiments: which cause moves a rock's value from view to view, and how much."""

from typing import TYPE_CHECKING

from validation.kinds.design.spec import DesignExperiment
from validation.suite.kind import Kind

KIND = Kind(
    name="design",
    spec=DesignExperiment,
    work="validation.kinds.design.work",
    judge="validation.kinds.design.judge",
    page="validation.kinds.design.page",
)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.execution.work import Work
    from validation.kinds.design import judge, page, work
    from validation.report.section import Page
    from validation.scores.judge import Judge

    _WORK: Work[DesignExperiment] = work
    _JUDGE: Judge[DesignExperiment] = judge
    _PAGE: Page[DesignExperiment] = page
