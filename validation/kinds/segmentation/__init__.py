"""Segmentation experiments: rocks found, beside plain baselines."""

from validation.kinds.segmentation.spec import SegmentationExperiment
from validation.suite.kind import Kind

KIND = Kind(
    name="segmentation",
    spec=SegmentationExperiment,
    work="validation.kinds.segmentation.work",
    judge="validation.kinds.segmentation.judge",
    page="validation.kinds.segmentation.page",
)
