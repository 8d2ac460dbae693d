"""Page of fused experiments: form from views alone and from views as one, by their poses."""

from markupsafe import Markup

from validation.execution.run import Run
from validation.kinds.fused.page.tables import form_rows
from validation.kinds.fused.spec import FusedExperiment
from validation.report.section import Room
from validation.report.template import render


def scenes_shown(experiment: FusedExperiment) -> None:
    """None: a fused rock has no picture of its own."""


def section(run: Run, experiment: FusedExperiment, _room: Room) -> Markup:
    """Section of an experiment."""
    return render("fused.html", __name__, e=experiment, rows=form_rows(run, experiment))
