"""What the page shows of each experiment."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from validation.execution.run import Run
from validation.kinds.shapes.scores import gap_shares
from validation.paper.prose import FIGURES, Quoted
from validation.records.pictures import Portrait
from validation.report.embedded_views import ShownPicture, shown_pictures
from validation.report.page_selection import RockKey
from validation.report.rank_table import RankTable, rank_table
from validation.report.rocks import Measured, RockTable, rock_table
from validation.report.scatter_chart import Plot, plots
from validation.scores.blocks import blocks_of
from validation.scores.expectations import claims_of
from validation.scores.score import Key, Score
from validation.scores.titles import REFERENCE, title_of_claim, unit_of
from validation.suite.experiments import SegmentationExperiment, ShapesExperiment, YardExperiment


@dataclass(frozen=True)
class Room:
    """What the page has room for, and the rocks that were chosen for it."""

    chosen: Mapping[RockKey, Sequence[Portrait]]
    most_points: int  # of a chart
    share: float  # of the bytes for pictures of whole views


@dataclass(frozen=True)
class YardSection:
    """What the page shows of an experiment of rocks."""

    experiment: YardExperiment
    plots: tuple[Plot, ...]
    views: tuple[int, ...]
    ranks: tuple[tuple[str, str, RankTable], ...]  # measure, unit, table
    pictures: tuple[ShownPicture, ...]
    table: RockTable
    rocks: int
    detected: int
    eligible: int
    extras: int


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
class ShapesSection:
    """What the page shows of an experiment of shapes."""

    experiment: ShapesExperiment
    plots: tuple[Plot, ...]
    rows: tuple[SeriesRow, ...]
    pictures: tuple[ShownPicture, ...]
    table: RockTable


@dataclass(frozen=True)
class SegmentationSection:
    """What the page shows of an experiment of segmentation."""

    experiment: SegmentationExperiment
    columns: tuple[str, ...]
    rows: tuple[tuple[str, Score | None, tuple[float, ...]], ...]  # way, its F1, its scores
    pictures: tuple[ShownPicture, ...]


def _parts(
    run: Run, experiment: Measured, room: Room
) -> tuple[tuple[Plot, ...], tuple[ShownPicture, ...], RockTable]:
    return (
        plots(run, experiment, room.chosen, most_points=room.most_points),
        shown_pictures(run, experiment.name, room.chosen, share=room.share),
        rock_table(run, experiment, room.chosen),
    )


def yard_section(run: Run, experiment: YardExperiment, room: Room) -> YardSection:
    """Return what the page shows of an experiment of rocks."""
    own = run.records[run.records["experiment"] == experiment.name]
    first = own[own["scene"] == 0]
    by_first = own[own["method"] == experiment.methods[0]]
    true_rocks = by_first[by_first["status"] != "extra"]
    shown = true_rocks[true_rocks["eligible"].astype(bool)]
    charts, pictures, table = _parts(run, experiment, room)
    return YardSection(
        experiment=experiment,
        plots=charts,
        views=tuple(sorted(int(view) for view in own["view"].unique())),
        ranks=tuple(
            (title_of_claim(claim), unit_of(claim.measure), rank_table(first, claim))
            for claim in claims_of(run.suite, experiment)
        ),
        pictures=pictures,
        table=table,
        rocks=len(true_rocks[["scene", "instance"]].drop_duplicates()),
        detected=int((shown["status"] == "matched").sum()),
        eligible=len(shown),
        extras=int((by_first["status"] == "extra").sum()),
    )


def shapes_section(run: Run, experiment: ShapesExperiment, room: Room) -> ShapesSection:
    """Return what the page shows of an experiment of shapes."""
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
    charts, pictures, table = _parts(run, experiment, room)
    return ShapesSection(experiment, charts, tuple(rows), pictures, table)


SEGMENTATION_COLUMNS = (
    "f1",
    "precision",
    "recall",
    "mean_iou",
    "boundary_px",
    "splits",
    "merges",
    "ground_error",
)


def segmentation_section(
    run: Run, experiment: SegmentationExperiment, room: Room
) -> SegmentationSection:
    """Return what the page shows of an experiment of segmentation: a row for each way."""
    scores = {score.name: score for score in run.scores}

    def score(way: str, key: str) -> Score | None:
        return scores.get(Key(experiment.name, "", way, "", key).name)

    rows = []
    for way in experiment.series:
        found = [score(way, key) for key in SEGMENTATION_COLUMNS]
        values = tuple(np.nan if one is None else one.value for one in found)
        rows.append((way, found[0], values))
    return SegmentationSection(
        experiment=experiment,
        columns=SEGMENTATION_COLUMNS,
        rows=tuple(rows),
        pictures=shown_pictures(run, experiment.name, room.chosen, share=room.share),
    )
