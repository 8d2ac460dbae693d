"""Parts of a section that every kind with measured rocks has: charts, whole views, rock table."""

from collections.abc import Callable
from dataclasses import dataclass

from validation.execution.run import Run
from validation.records.join import RecordKey
from validation.report.embedded_views import ShownPicture, shown_pictures
from validation.report.rocks import ROCKS, RockTable, Subject, rock_table
from validation.report.scatter_chart import Plot, plots
from validation.report.section import Room
from validation.suite.experiment import Experiment


@dataclass(frozen=True)
class MeasuredParts:
    """Charts of measured against true values, pictures of whole views, and the rocks one by one."""

    plots: tuple[Plot, ...]
    pictures: tuple[ShownPicture, ...]
    table: RockTable


def measured_parts(
    run: Run,
    experiment: Experiment,
    room: Room,
    *,
    words: Callable[[RecordKey], tuple[str, str]],
    subject: Subject = ROCKS,
) -> MeasuredParts:
    """Parts of an experiment; `words` says what a picture shows."""
    return MeasuredParts(
        plots(run, experiment, room.chosen, most_points=room.most_points, what=subject.what),
        shown_pictures(run, experiment.name, room.chosen, words=words, share=room.share),
        rock_table(run, experiment, room.chosen, subject),
    )
