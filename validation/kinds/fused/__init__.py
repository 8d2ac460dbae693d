"""Fused experiments: several views of the same rocks as one, beside each view by itself."""

from typing import TYPE_CHECKING

from validation.kinds.fused.spec import FusedExperiment
from validation.suite.kind import folder_kind

KIND = folder_kind(__name__, FusedExperiment)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.kinds.fused import judge, page, work
    from validation.kinds.modules import Modules

    _MODULES: Modules[FusedExperiment] = work, judge, page
