"""Multi-view experiments: the same rocks seen from several views."""

from typing import TYPE_CHECKING

from validation.kinds.multiview.spec import MultiviewExperiment
from validation.suite.kind import folder_kind

KIND = folder_kind(__name__, MultiviewExperiment, aliases=("yard",))

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.kinds.modules import MeasuredModules
    from validation.kinds.multiview import judge, page, work

    _MODULES: MeasuredModules[MultiviewExperiment] = work, judge, page
