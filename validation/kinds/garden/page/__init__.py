"""Page of gardens: that of multi-view experiments, and the paper's tables 4 and 5."""

from markupsafe import Markup

from validation.execution.run import Run
from validation.kinds.garden.page.tables import garden_tables
from validation.kinds.garden.spec import GardenExperiment
from validation.kinds.multiview.page import __name__ as multiview
from validation.kinds.multiview.page import scenes_shown, views_summary
from validation.report.section import Room
from validation.report.template import render

__all__ = ["scenes_shown", "section"]


def section(run: Run, experiment: GardenExperiment, room: Room) -> Markup:
    """Section of an experiment."""
    return render(
        "garden.html",
        __name__,
        multiview,
        y=views_summary(run, experiment, room),
        g=garden_tables(run, experiment),
    )
