"""Page of pebbles: what each resolution leaves of each measure, and whose pictures they are."""

from markupsafe import Markup

from validation.execution.run import Run
from validation.kinds.pebbles.judge import STATISTICS
from validation.kinds.pebbles.spec import PebblesExperiment
from validation.report.section import Room
from validation.report.template import render
from validation.scores.score import Key
from validation.scores.scoring import claims_of
from validation.scores.titles import title_of_claim


def scenes_shown(experiment: PebblesExperiment) -> None:
    """None: pebbles are not shown one by one."""


def section(run: Run, experiment: PebblesExperiment, _room: Room) -> Markup:
    """Section of an experiment."""
    scores = {score.key: score for score in run.scores}
    rows = [
        (
            title_of_claim(claim),
            claim.series,
            [
                scores[Key(claim.experiment, claim.method, claim.series, claim.measure, each.key)]
                for each in STATISTICS
            ],
        )
        for claim in claims_of(run.suite, experiment)
    ]
    return render(
        "pebbles.html",
        __name__,
        experiment=experiment,
        rows=rows,
        credits=experiment.pictures.credits(),
    )
