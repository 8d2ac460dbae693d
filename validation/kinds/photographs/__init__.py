"""MaskedPicture experiments: rocks found in pictures with known masks, without range."""

from typing import TYPE_CHECKING

from validation.kinds.photographs.spec import PhotographsExperiment
from validation.suite.kind import folder_kind

KIND = folder_kind(__name__, PhotographsExperiment)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.kinds.modules import Modules
    from validation.kinds.photographs import judge, page, work

    _MODULES: Modules[PhotographsExperiment] = work, judge, page
