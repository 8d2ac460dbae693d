"""Page of segmentation experiments: a row of scores for each way."""

import numpy as np
from markupsafe import Markup

from validation.execution.run import Run
from validation.kinds.segmentation.spec import SegmentationExperiment
from validation.records.join import RecordKey
from validation.report.embedded_views import shown_pictures
from validation.report.section import Room
from validation.report.template import render
from validation.scores.score import Key, Score

COLUMNS = (
    "f1",
    "precision",
    "recall",
    "mean_iou",
    "boundary_px",
    "splits",
    "merges",
    "ground_error",
)


def scenes_shown(experiment: SegmentationExperiment) -> None:
    """None: rocks that are only found are not shown one by one."""


def _words(place: RecordKey) -> tuple[str, str]:
    return (
        f"Rocks of seed {place.seed} by {place.series}: true borders blue, found yellow",
        f"{place.series}, seed {place.seed}, view {place.view + 1}",
    )


def section(run: Run, experiment: SegmentationExperiment, room: Room) -> Markup:
    """Section of an experiment."""
    scores = {score.name: score for score in run.scores}

    def score(way: str, key: str) -> Score | None:
        return scores.get(Key(experiment.name, "", way, "", key).name)

    rows = []
    for way in experiment.series:
        found = [score(way, key) for key in COLUMNS]
        values = tuple(np.nan if one is None else one.value for one in found)
        rows.append((way, found[0], values))
    return render(
        "segmentation.html",
        __name__,
        experiment=experiment,
        columns=COLUMNS,
        rows=rows,
        shown=shown_pictures(run, experiment.name, room.chosen, words=_words, share=room.share),
    )
