"""Table of fused experiments: how near the form comes, a row a method and kind of pose."""

from dataclasses import dataclass

from validation.execution.run import Run
from validation.kinds.fused.judge import claims
from validation.kinds.fused.spec import ALONE, EXACT, GIVEN, REFINED, FusedExperiment
from validation.scores.score import Key, Score

_WORDS = {
    ALONE: "each view alone",
    GIVEN: "views fused, poses as reported",
    REFINED: "views fused, poses refined",
    EXACT: "views fused, poses exact",
}


@dataclass(frozen=True)
class FormRow:
    """Scores of one measure of form in one way."""

    words: str
    method: str
    column: str
    matched: Score | None  # None of views alone
    error: Score
    bias: Score
    tau: Score


def form_rows(run: Run, experiment: FusedExperiment) -> list[FormRow]:
    """Rows of the table, the views alone first."""
    scores = {score.key: score for score in run.scores}
    rows = []
    for claim in claims(experiment, run.suite.measures):
        place = (experiment.name, claim.method, claim.series)
        error, bias, tau = (
            scores[Key(*place, claim.measure, statistic)] for statistic in ("error", "bias", "tau")
        )
        matched = scores.get(Key(*place, "", "matched"))
        words = _WORDS[claim.series]
        rows.append(FormRow(words, claim.method, claim.measure, matched, error, bias, tau))
    return rows
