"""Garden comparison: the paper's tables 4 and 5."""

from typing import TYPE_CHECKING

from validation.kinds.garden.spec import GardenExperiment
from validation.suite.kind import Kind, Table


def _is_pan(table: Table) -> bool:
    """Tell whether an older table of rocks, when gardens had no kind, is one."""
    scene = table.get("scene") or {}
    return bool((scene.get("views") or {}).get("path") == "pan" and not table.get("sweep"))


KIND = Kind(
    name="garden",
    spec=GardenExperiment,
    work="validation.kinds.multiview.work",
    judge="validation.kinds.garden.judge",
    page="validation.kinds.garden.page",
    aliases=("yard",),
    adopts=_is_pan,
)

if TYPE_CHECKING:  # the modules hold what their protocols ask
    from validation.execution.work import MeasuredWork
    from validation.kinds.garden import judge, page
    from validation.kinds.multiview import work
    from validation.report.section import Page
    from validation.scores.judge import Judge

    _WORK: MeasuredWork[GardenExperiment] = work
    _JUDGE: Judge[GardenExperiment] = judge
    _PAGE: Page[GardenExperiment] = page
