"""Page of designed experiments: their scores stand in the page's table of all scores alone."""

from markupsafe import Markup

from validation.execution.run import Run
from validation.kinds.design.spec import DesignExperiment
from validation.report.section import Room


def scenes_shown(experiment: DesignExperiment) -> None:
    """None: no pictures are kept of so many cells."""


def section(_run: Run, _experiment: DesignExperiment, _room: Room) -> Markup:
    """No section."""
    return Markup("")
