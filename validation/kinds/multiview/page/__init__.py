"""Page of multi-view experiments: measured against true, ranks, rocks, and the paper's tables."""

from markupsafe import Markup

from validation.execution.run import Run
from validation.kinds.multiview.page.beside_paper import beside_paper
from validation.kinds.multiview.page.summary import view_words, views_summary
from validation.kinds.multiview.page.sweeps import sweep_summary
from validation.kinds.multiview.spec import MultiviewExperiment
from validation.paper import CONSISTENCY_TABLES
from validation.report.section import Room
from validation.report.template import render

__all__ = ["scenes_shown", "section", "view_words", "views_summary"]


def scenes_shown(experiment: MultiviewExperiment) -> int:
    """Number of pictured scenes."""
    return experiment.pictured


def section(run: Run, experiment: MultiviewExperiment, room: Room) -> Markup:
    """Section of an experiment; of a sweep, its charts over the steps."""
    if experiment.sweep is not None:
        summary = sweep_summary(run, experiment, room)
        return render("sweep.html", __name__, w=summary)
    return render(
        "multiview.html",
        __name__,
        y=views_summary(run, experiment, room),
        beside=beside_paper(run, experiment),
        tables=CONSISTENCY_TABLES,
    )
