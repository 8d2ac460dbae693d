"""Frame experiments: the frames of the paper's figures 11 and 12, held to what it says of them."""

from typing import TYPE_CHECKING

from validation.kinds.frames.spec import FramesExperiment
from validation.suite.kind import folder_kind

KIND = folder_kind(__name__, FramesExperiment)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.kinds.frames import judge, page, work
    from validation.kinds.modules import MeasuredModules

    _MODULES: MeasuredModules[FramesExperiment] = work, judge, page
