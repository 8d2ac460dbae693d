"""Multi-view experiments: the same rocks seen from several views."""

from typing import TYPE_CHECKING

from validation.kinds.multiview.spec import MultiviewExperiment
from validation.suite.kind import Kind

KIND = Kind(
    name="multiview",
    spec=MultiviewExperiment,
    work="validation.kinds.multiview.work",
    judge="validation.kinds.multiview.judge",
    page="validation.kinds.multiview.page",
    aliases=("yard",),
)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.execution.work import MeasuredWork
    from validation.kinds.multiview import judge, page, work
    from validation.report.section import Page
    from validation.scores.judge import Judge

    _WORK: MeasuredWork[MultiviewExperiment] = work
    _JUDGE: Judge[MultiviewExperiment] = judge
    _PAGE: Page[MultiviewExperiment] = page
