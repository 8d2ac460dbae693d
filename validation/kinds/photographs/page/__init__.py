"""Page of photographs: a row of scores for each finder, tables by size and of the consequence."""

import math
from collections.abc import Mapping, Sequence

from markupsafe import Markup

from validation.execution.run import Run
from validation.kinds.photographs.judge.consequence import (
    AXES,
    PERCENTILES,
    SHAPES,
    percentile_ratios,
)
from validation.kinds.photographs.judge.objects import SIZES_PX
from validation.kinds.photographs.spec import PhotographsExperiment
from validation.records.join import RecordKey
from validation.report.embedded_views import shown_pictures
from validation.report.section import Room
from validation.report.template import render
from validation.scores.object_scores import range_name
from validation.scores.score import Key, Score

WHOLE = ("f1", "precision", "recall", "ap", "mean_iou", "pixel_iou", "splits", "merges")


def scenes_shown(experiment: PhotographsExperiment) -> None:
    """None: rocks of photographs are not shown one by one."""


def section(run: Run, experiment: PhotographsExperiment, room: Room) -> Markup:
    """Section of an experiment."""
    scores = {score.name: score for score in run.scores}
    told = experiment.pictures.has_instances
    sizes = [range_name(low, high) for low, high in SIZES_PX]
    grain_sizes = [(axis, f"d{p}_bias") for axis in AXES for p in PERCENTILES]
    shapes = [(name, s) for name in (*AXES, *SHAPES) for s in ("bias", "spread", "coverage")]

    def words(place: RecordKey) -> tuple[str, str]:
        name = experiment.pictures.name(place.scene)
        caption = f"{place.series}, {name}"
        return f"Rocks found in {name} by {place.series}", caption

    return render(
        "photographs.html",
        __name__,
        experiment=experiment,
        told=told,
        credits=experiment.pictures.credits(),
        whole=_rows(scores, experiment, [("", name) for name in WHOLE if told or "pixel" in name]),
        columns=[name for name in WHOLE if told or "pixel" in name],
        sizes=[f"{low:g} px and more" if high == float("inf") else f"{low:g} to {high:g} px"
               for low, high in SIZES_PX],
        by_size=_rows(scores, experiment, [("", f"f1_{size}") for size in sizes]),
        counts=_counts(scores, experiment, sizes),
        grain_sizes=_rows(scores, experiment, grain_sizes),
        by_picture=_by_picture(run, experiment) if told else (),
        shapes=_rows(scores, experiment, shapes),
        axes=tuple(AXES.values()),
        quantities=(*AXES.values(), *SHAPES.values()),
        shown=shown_pictures(run, experiment.name, room.chosen, words=words, share=room.share),
    )  # fmt: skip


def _rows(
    scores: Mapping[str, Score],
    experiment: PhotographsExperiment,
    columns: Sequence[tuple[str, str]],
) -> list[tuple[str, list[Score | None]]]:
    """Finder and its scores of (measure, statistic)."""
    return [
        (
            series,
            [
                scores.get(Key(experiment.name, "", series, measure, statistic).name)
                for measure, statistic in columns
            ],
        )
        for series in experiment.series
    ]


def _counts(
    scores: Mapping[str, Score], experiment: PhotographsExperiment, sizes: Sequence[str]
) -> list[int]:
    """True rocks of each size, which are the same for all finders."""
    (_, found), *_ = _rows(scores, experiment, [("", f"recall_{size}") for size in sizes])
    return [0 if score is None else score.count for score in found]


def _by_picture(
    run: Run, experiment: PhotographsExperiment
) -> list[tuple[str, str, int, int, list[float]]]:
    """Picture, finder, true and matched rocks, and ratios of the percentiles of both axes."""
    own = run.records[run.records["experiment"] == experiment.name]
    of_series = {series: own[own["series"] == series] for series in experiment.series}
    ratios = {
        series: [percentile_ratios(rows, axis, p) for axis in AXES for p in PERCENTILES]
        for series, rows in of_series.items()
    }
    table = []
    for number in range(experiment.pictures.count):
        for series, rows in of_series.items():
            status = rows.loc[rows["scene"] == number, "status"]
            matched = int((status == "matched").sum())
            true = matched + int((status == "missed").sum())
            of_each = [float(ratio.get(number, math.nan)) for ratio in ratios[series]]
            table.append((experiment.pictures.name(number), series, true, matched, of_each))
    return table
