"""Designed experiments: which cause moves a rock's value from view to view, and how much."""

from typing import TYPE_CHECKING

from validation.kinds.design.spec import DesignExperiment
from validation.suite.kind import folder_kind

KIND = folder_kind(__name__, DesignExperiment)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.kinds.design import judge, page, work
    from validation.kinds.modules import Modules

    _MODULES: Modules[DesignExperiment] = work, judge, page
