"""Page of frames: the named rocks' values beside the paper's, and which of its orders come out."""

from markupsafe import Markup

from validation.execution.run import Run
from validation.kinds.frames.page.tables import orders, rock_values
from validation.kinds.frames.spec import FramesExperiment
from validation.report.section import Room
from validation.report.template import render


def scenes_shown(experiment: FramesExperiment) -> None:
    """None: the rocks that count are all in the table."""


def section(run: Run, experiment: FramesExperiment, _room: Room) -> Markup:
    """Section of an experiment."""
    return render(
        "frames.html",
        __name__,
        experiment=experiment,
        rocks=rock_values(run, experiment),
        orders=orders(run, experiment),
    )
