"""Summary of drawn shapes: the values of the first drawing, and the gaps between neighbours."""

from dataclasses import dataclass

from validation.execution.run import Run
from validation.kinds.shapes.judge import gap_shares
from validation.kinds.shapes.spec import ShapesExperiment
from validation.paper.prose import FIGURES, Quoted
from validation.records.join import RecordKey
from validation.report.measured_parts import MeasuredParts, measured_parts
from validation.report.rocks import Subject
from validation.report.section import Room
from validation.scores.blocks import blocks_of
from validation.scores.scoring import claims_of
from validation.scores.titles import REFERENCE, title_of_claim

SHAPES = Subject("shape", several_views=False, outlines_only=True)


@dataclass(frozen=True)
class SeriesRow:
    """One measure on one series: the paper's words and the values of the first drawing."""

    title: str
    column: str
    values: tuple[float, ...]
    gaps: tuple[float, ...]  # shares of the whole way
    true_gaps: tuple[float, ...]
    quoted: Quoted | None  # None where the paper has no such number


@dataclass(frozen=True)
class ShapesSummary:
    """Everything that the page shows of an experiment of shapes."""

    experiment: ShapesExperiment
    parts: MeasuredParts
    rows: tuple[SeriesRow, ...]


def _words(place: RecordKey) -> tuple[str, str]:
    return (
        f"Shapes of the series {place.series} with their outlines and fitted ellipses",
        f"series {place.series}, seed {place.seed}",
    )


def shapes_summary(run: Run, experiment: ShapesExperiment, room: Room) -> ShapesSummary:
    """Summary of an experiment."""
    own = run.records[run.records["experiment"] == experiment.name]
    first = own[own["scene"] == 0]
    rows = []
    for claim in claims_of(run.suite, experiment):
        block = blocks_of(first, claim)[0]
        values = block.values[0]
        quoted = FIGURES.get((claim.series, claim.measure))
        rows.append(
            SeriesRow(
                title=title_of_claim(claim),
                column=claim.measure,
                values=tuple(values.tolist()),
                gaps=tuple(gap_shares(values).tolist()),
                true_gaps=tuple(gap_shares(block.truth).tolist()),
                quoted=quoted if claim.method == REFERENCE else None,
            )
        )
    parts = measured_parts(run, experiment, room, words=_words, subject=SHAPES)
    return ShapesSummary(experiment, parts, tuple(rows))
