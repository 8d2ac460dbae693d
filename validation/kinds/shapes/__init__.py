"""Shape experiments: drawn series of known outlines."""

from typing import TYPE_CHECKING

from validation.kinds.shapes.spec import ShapesExperiment
from validation.suite.kind import folder_kind

KIND = folder_kind(__name__, ShapesExperiment)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.kinds.modules import MeasuredModules
    from validation.kinds.shapes import judge, page, work

    _MODULES: MeasuredModules[ShapesExperiment] = work, judge, page
