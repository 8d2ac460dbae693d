"""Everybody's rank: the columns of all methods and measures by how well they order each truth."""

import math
from dataclasses import dataclass

from validation.execution.run import Run
from validation.report.format import interval, number
from validation.scores.expectations import TRUTH
from validation.scores.judge import judge_of
from validation.scores.score import Key, Score

_TRUTHS = {
    "truth_angularity": "angularity",
    "truth_roundness": "angularity",  # one order, read from either end
    "truth_roughness": "roughness",
    "truth_maximum_projection_sphericity": "form",
    "truth_axis_ratio": "form",
    "truth_rectangle_ratio": "form",
}


@dataclass(frozen=True)
class Rank:
    """One column's place; columns of one τ share a rank, and one without τ has none."""

    rank: int | None
    method: str
    measure: str
    tau: Score
    cv: float  # of one rock's value across views; NaN for drawings


@dataclass(frozen=True)
class Board:
    """The places for one truth in one experiment."""

    experiment: str
    truth: str
    places: tuple[Rank, ...]


def leaderboards(run: Run) -> tuple[Board, ...]:
    """Board for each experiment that has one and each truth, the best order first."""
    scores = {score.name: score for score in run.scores}
    entries: dict[tuple[str, str], list[tuple[Score, float]]] = {}
    claims = [
        claim
        for experiment in run.suite.experiments
        for claim in judge_of(experiment).ranked_claims(experiment, run.suite.measures)
    ]
    for claim in claims:
        parts = (claim.experiment, claim.method, claim.series, claim.measure)
        cv = scores.get(Key(*parts, "cv").name)
        truth = _TRUTHS.get(claim.truth, claim.truth.removeprefix(TRUTH))
        board = entries.setdefault((claim.experiment, truth), [])
        board.append((scores[Key(*parts, "tau").name], math.nan if cv is None else cv.value))
    return tuple(
        Board(experiment, truth, _ranked(found)) for (experiment, truth), found in entries.items()
    )


def _ranked(found: list[tuple[Score, float]]) -> tuple[Rank, ...]:
    taus = [tau.value for tau, _ in found]
    places = [
        Rank(
            rank=None if math.isnan(tau.value) else 1 + sum(other > tau.value for other in taus),
            method=tau.key.method,
            measure=tau.key.measure,
            tau=tau,
            cv=cv,
        )
        for tau, cv in found
    ]
    return tuple(sorted(places, key=lambda place: (place.rank is None, place.rank)))


def leaderboard_lines(run: Run) -> list[str]:
    """Boards as Markdown."""
    lines = []
    for board in leaderboards(run):
        lines += [
            "",
            f"### {board.experiment}: order by {board.truth}",
            "",
            "| rank | method | measure | τ_b | 95 % interval | variation between views |",
            "| --- | --- | --- | --- | --- | --- |",
        ]
        lines += [
            f"| {place.rank or '–'} | {place.method} | `{place.measure}` "
            f"| {number(place.tau.value)} | {interval(place.tau.low, place.tau.high)} "
            f"| {number(place.cv)} |"
            for place in board.places
        ]
    return lines
