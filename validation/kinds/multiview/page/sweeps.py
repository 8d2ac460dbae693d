"""Summary of a sweep: each measure's order and variation over the steps."""

import math
from dataclasses import dataclass

from markupsafe import Markup

from rockshape.method import find_method
from validation.execution.run import Run
from validation.kinds.multiview.page.summary import view_words
from validation.kinds.multiview.spec import MultiviewExperiment
from validation.report.embedded_views import ShownPicture, shown_pictures
from validation.report.line_chart import Line, line_chart
from validation.report.rocks import RockTable, rock_table
from validation.report.section import Room
from validation.scores.score import Key, Score

_CHARTED = (  # statistic, heading, the least top of its axis
    ("tau", "Order within a view (τ_b)", 1.0),
    ("cv", "Variation of a rock between views (CV)", 0.25),
)
MIN_COUNT = 10  # pairs or rocks, below which a score is not drawn


@dataclass(frozen=True)
class SweepSummary:
    """A sweep's charts by what they show, its recall by method and step, its pictures."""

    experiment: MultiviewExperiment
    steps: tuple[str, ...]  # as the page writes them
    charts: tuple[tuple[str, tuple[tuple[str, Markup], ...]], ...]  # heading: (measure, chart)
    recall: tuple[tuple[str, tuple[Score, ...]], ...]  # method, a score a step
    measured: tuple[tuple[str, tuple[float, ...]], ...]  # method and measure, share with a value
    table: RockTable
    pictures: tuple[ShownPicture, ...]
    fewest: int = MIN_COUNT


def _columns(experiment: MultiviewExperiment) -> dict[str, dict[str, str]]:
    """{measure's title: {method: column}}, in the order of the methods' measures."""
    columns: dict[str, dict[str, str]] = {}
    for method in experiment.methods:
        for measure in find_method(method).measures:
            columns.setdefault(measure.title, {})[method] = measure.column
    return columns


def _line(
    scores: dict[str, Score],
    experiment: MultiviewExperiment,
    method: str,
    column: str,
    statistic: str,
) -> Line:
    found = [
        scores.get(Key(experiment.name, method, step, column, statistic).name)
        for step in experiment.series
    ]
    drawn = [score if score and score.count >= MIN_COUNT else None for score in found]
    return Line(
        name=method,
        style=experiment.methods.index(method),
        values=tuple(score.value if score else math.nan for score in drawn),
        lows=tuple(score.low if score else math.nan for score in drawn),
        highs=tuple(score.high if score else math.nan for score in drawn),
    )


def _measured(
    run: Run, experiment: MultiviewExperiment
) -> tuple[tuple[str, tuple[float, ...]], ...]:
    """Share of found rocks in plain view that got a value, where not all did."""
    own = run.records[run.records["experiment"] == experiment.name]
    shown = own[(own["status"] == "matched") & own["eligible"].astype(bool)]
    rows = []
    for title, columns in _columns(experiment).items():
        for method, column in columns.items():
            of_method = shown[shown["method"] == method]
            shares = of_method[column].notna().groupby(of_method["series"]).mean()
            values = tuple(float(shares.get(step, math.nan)) for step in experiment.series)
            if any(value < 1 for value in values):
                rows.append((f"{title} ({method})", values))
    return tuple(rows)


def sweep_summary(run: Run, experiment: MultiviewExperiment, room: Room) -> SweepSummary:
    """What the page shows of an experiment with a sweep."""
    if experiment.sweep is None:
        raise ValueError(f"{experiment.name}: expected an experiment with a sweep")
    scores = {score.name: score for score in run.scores}
    sweep = experiment.sweep
    steps = tuple(s.replace("p", ".") if s[0].isdigit() else s for s in sweep.steps)
    charts = tuple(
        (
            heading,
            tuple(
                (
                    title,
                    line_chart(
                        [
                            _line(scores, experiment, method, column, statistic)
                            for method, column in columns.items()
                        ],
                        steps=steps,
                        x_title=sweep.title,
                        title=f"{title}: {heading}",
                        most=most,
                    ),
                )
                for title, columns in _columns(experiment).items()
            ),
        )
        for statistic, heading, most in _CHARTED
    )
    return SweepSummary(
        experiment=experiment,
        steps=steps,
        charts=charts,
        recall=tuple(
            (
                method,
                tuple(
                    scores[Key(experiment.name, method, s, "", "recall").name] for s in sweep.steps
                ),
            )
            for method in experiment.methods
        ),
        measured=_measured(run, experiment),
        table=rock_table(run, experiment, room.chosen),
        pictures=shown_pictures(
            run, experiment.name, room.chosen, words=view_words, share=room.share
        ),
    )
