"""Shape experiments: drawn series of known outlines."""

from typing import TYPE_CHECKING

from validation.kinds.shapes.spec import ShapesExperiment
from validation.suite.kind import Kind

KIND = Kind(
    name="shapes",
    spec=ShapesExperiment,
    work="validation.kinds.shapes.work",
    judge="validation.kinds.shapes.judge",
    page="validation.kinds.shapes.page",
)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.execution.work import MeasuredWork
    from validation.kinds.shapes import judge, page, work
    from validation.report.section import Page
    from validation.scores.judge import Judge

    _WORK: MeasuredWork[ShapesExperiment] = work
    _JUDGE: Judge[ShapesExperiment] = judge
    _PAGE: Page[ShapesExperiment] = page
