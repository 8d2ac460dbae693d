"""Segmentation experiments: rocks found, beside plain baselines."""

from typing import TYPE_CHECKING

from validation.kinds.segmentation.spec import SegmentationExperiment
from validation.suite.kind import Kind

KIND = Kind(
    name="segmentation",
    spec=SegmentationExperiment,
    work="validation.kinds.segmentation.work",
    judge="validation.kinds.segmentation.judge",
    page="validation.kinds.segmentation.page",
)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.execution.work import Work
    from validation.kinds.segmentation import judge, page, work
    from validation.report.section import Page
    from validation.scores.judge import Judge

    _WORK: Work[SegmentationExperiment] = work
    _JUDGE: Judge[SegmentationExperiment] = judge
    _PAGE: Page[SegmentationExperiment] = page
