"""Segmentation experiments: rocks found, beside plain baselines."""

from typing import TYPE_CHECKING

from validation.kinds.segmentation.spec import SegmentationExperiment
from validation.suite.kind import folder_kind

KIND = folder_kind(__name__, SegmentationExperiment)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.kinds.modules import Modules
    from validation.kinds.segmentation import judge, page, work

    _MODULES: Modules[SegmentationExperiment] = work, judge, page
