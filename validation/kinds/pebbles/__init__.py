"""Pebble experiments: real pebbles with known masks, at several resolutions."""

from typing import TYPE_CHECKING

from validation.kinds.pebbles.spec import PebblesExperiment
from validation.suite.kind import folder_kind

KIND = folder_kind(__name__, PebblesExperiment)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.kinds.modules import MeasuredModules
    from validation.kinds.pebbles import judge, page, work

    _MODULES: MeasuredModules[PebblesExperiment] = work, judge, page
