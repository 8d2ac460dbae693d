"""Summary of rocks seen from several views: how many were found, and their ranks in each view."""

from dataclasses import dataclass

from validation.execution.run import Run
from validation.kinds.multiview.spec import MultiviewExperiment
from validation.records.join import RecordKey
from validation.report.measured_parts import MeasuredParts, measured_parts
from validation.report.rank_table import RankTable, rank_table
from validation.report.section import Room
from validation.scores.scoring import claims_of
from validation.scores.titles import title_of_claim, unit_of


@dataclass(frozen=True)
class ViewsSummary:
    """Everything that the page shows of an experiment without a sweep."""

    experiment: MultiviewExperiment
    parts: MeasuredParts
    views: tuple[int, ...]
    ranks: tuple[tuple[str, str, RankTable], ...]  # measure, unit, table
    rocks: int
    detected: int
    eligible: int
    extras: int


def view_words(place: RecordKey) -> tuple[str, str]:
    """What a picture shows, in full and as a caption."""
    caption = f"seed {place.seed}, view {place.view + 1}"
    return f"Rocks of {caption}, outlined and numbered", caption


def views_summary(run: Run, experiment: MultiviewExperiment, room: Room) -> ViewsSummary:
    """Summary of an experiment."""
    own = run.records[run.records["experiment"] == experiment.name]
    first = own[own["scene"] == 0]
    by_first = own[own["method"] == experiment.methods[0]]
    true_rocks = by_first[by_first["status"] != "extra"]
    shown = true_rocks[true_rocks["eligible"].astype(bool)]
    return ViewsSummary(
        experiment=experiment,
        parts=measured_parts(run, experiment, room, words=view_words),
        views=tuple(sorted(int(view) for view in own["view"].unique())),
        ranks=tuple(
            (title_of_claim(claim), unit_of(claim.measure), rank_table(first, claim))
            for claim in claims_of(run.suite, experiment)
        ),
        rocks=len(true_rocks[["scene", "instance"]].drop_duplicates()),
        detected=int((shown["status"] == "matched").sum()),
        eligible=len(shown),
        extras=int((by_first["status"] == "extra").sum()),
    )
