"""Page of shapes experiments: the paper's words and ours, series by series."""

from markupsafe import Markup

from validation.execution.run import Run
from validation.kinds.shapes.page.summary import shapes_summary
from validation.kinds.shapes.spec import ShapesExperiment
from validation.report.section import Room
from validation.report.template import render


def scenes_shown(_experiment: ShapesExperiment) -> int:
    """One: the first drawing of each series."""
    return 1


def section(run: Run, experiment: ShapesExperiment, room: Room) -> Markup:
    """Section of an experiment."""
    return render("shapes.html", __name__, s=shapes_summary(run, experiment, room))
