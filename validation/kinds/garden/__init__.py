"""Garden comparison: the paper's tables 4 and 5."""

from typing import TYPE_CHECKING

from validation.kinds.garden.spec import GardenExperiment
from validation.suite.kind import Table, folder_kind


def _is_pan(table: Table) -> bool:
    """Tell whether an older table of rocks, when gardens had no kind, is one."""
    scene = table.get("scene") or {}
    return bool((scene.get("views") or {}).get("path") == "pan" and not table.get("sweep"))


KIND = folder_kind(
    __name__,
    GardenExperiment,
    work="validation.kinds.multiview.work",
    aliases=("yard",),
    adopts=_is_pan,
)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.kinds.garden import judge, page
    from validation.kinds.modules import MeasuredModules
    from validation.kinds.multiview import work

    _MODULES: MeasuredModules[GardenExperiment] = work, judge, page
