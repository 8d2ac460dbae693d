"""The paper's tables 4 and 5 beside ours: which measures go together, and rocks seen twice."""

from dataclasses import dataclass

from validation.execution.run import Run
from validation.kinds.garden.judge import COUPLES, rho_key
from validation.kinds.garden.spec import GardenExperiment
from validation.paper import GARDEN_COLUMNS, garden_correlation, garden_rank_move
from validation.scores.score import Key, Score
from validation.scores.titles import column_of, title_of


@dataclass(frozen=True)
class GardenRow:
    """A number of the paper and ours by each method."""

    title: str
    paper: float
    ours: tuple[Score, ...]


@dataclass(frozen=True)
class GardenTables:
    """What tables 4 and 5 amount to, theirs and ours."""

    methods: tuple[str, ...]
    together: tuple[GardenRow, ...]  # Spearman's ρ of two measures
    moves: tuple[GardenRow, ...]  # rank of a rock seen twice


def garden_tables(run: Run, experiment: GardenExperiment) -> GardenTables:
    """Both comparisons for a field seen frame by frame."""
    scores = {score.name: score for score in run.scores}
    together = tuple(
        GardenRow(
            title=f"{title_of(couple.first)} with {title_of(couple.second)}",
            paper=garden_correlation(*(GARDEN_COLUMNS[column] for column in couple)),
            ours=tuple(
                scores[rho_key(experiment.name, m, couple).name] for m in experiment.methods
            ),
        )
        for couple in COUPLES
    )
    moves = tuple(
        GardenRow(
            title=title_of(column),
            paper=garden_rank_move(printed),
            ours=tuple(
                scores[Key(experiment.name, m, "", column_of(m, column), "rank_move").name]
                for m in experiment.methods
            ),
        )
        for column, printed in GARDEN_COLUMNS.items()
    )
    return GardenTables(experiment.methods, together, moves)
