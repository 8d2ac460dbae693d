"""The paper's tables 1 to 3 beside the scores of the same statistics."""

from validation.execution.run import Run
from validation.kinds.multiview.spec import MultiviewExperiment
from validation.paper import CONSISTENCY_TABLES
from validation.paper.statistics import paper_values
from validation.scores.agreement import STATISTICS
from validation.scores.score import Score
from validation.scores.titles import REFERENCE

Row = tuple[str, tuple[tuple[float, Score], ...]]  # title; paper's and ours for each measure


def beside_paper(run: Run, experiment: MultiviewExperiment) -> tuple[Row, ...]:
    """Row for each statistic; none where nothing is judged as in the paper."""
    if "angularity" not in experiment.varied or REFERENCE not in experiment.methods:
        return ()
    ours = {score.name: score for score in run.scores}
    paper = paper_values()
    return tuple(
        (
            statistic.title,
            tuple(
                (
                    paper[measure][statistic.key],
                    ours[f"{experiment.name}.{measure}.{statistic.key}"],
                )
                for measure in CONSISTENCY_TABLES
            ),
        )
        for statistic in STATISTICS
    )
