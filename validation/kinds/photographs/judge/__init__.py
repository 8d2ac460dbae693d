"""Judge of photographs: objects and pixels found, and the shape that their outlines tell."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from validation.kinds.photographs.judge.consequence import consequence_scores
from validation.kinds.photographs.judge.objects import object_scores, pixel_scores
from validation.kinds.photographs.judge.record import ScoreOf
from validation.kinds.photographs.readings import QUANTITIES, TRUE
from validation.kinds.photographs.spec import PhotographsExperiment
from validation.peers import MeasureSpec
from validation.scores.expectations import Claim
from validation.scores.judge import Feeds
from validation.scores.score import Definition, Estimate, Key
from validation.selfcheck.feeds import found_all, missed_all


def claims(
    _experiment: PhotographsExperiment,
    _measures: Sequence[MeasureSpec],
) -> tuple[Claim, ...]:
    """None: no trait is varied in a photograph."""
    return ()


view_claims = ranked_claims = claims


def scores_of(experiment: PhotographsExperiment) -> tuple[ScoreOf, ...]:
    """Scores of each series; of pixels alone where no rocks are told apart."""
    if not experiment.pictures.has_instances:
        return tuple(pixel_scores())
    return (*object_scores(), *pixel_scores(), *consequence_scores())


def definitions(
    experiment: PhotographsExperiment,
    _measures: Sequence[MeasureSpec],
) -> tuple[Definition, ...]:
    """Scores of an experiment, finder by finder."""
    return tuple(
        _definition(experiment.name, series, score)
        for series in experiment.series
        for score in scores_of(experiment)
    )


def _definition(experiment: str, series: str, score: ScoreOf) -> Definition:
    def compute(records: pd.DataFrame) -> Estimate:
        own = (records["experiment"] == experiment) & (records["series"] == series)
        return score.compute(records[own])

    return Definition(
        key=Key(experiment, "", series, score.measure, score.statistic),
        title=f"{series}: {score.title}",
        unit=score.unit,
        counted=score.counted,
        better=score.better,
        compute=compute,
    )


def _oracle(records: pd.DataFrame, _claims: Sequence[Claim]) -> pd.DataFrame:
    """Records in which every rock is found to the pixel."""
    fed = found_all(records)
    fed["common_px"] = fed["union_px"]
    for column in QUANTITIES.values():
        if column in fed:  # where rocks are told apart
            fed[column] = fed[TRUE + column]
    return fed.assign(**{name: False for name in ("split", "merged") if name in fed})


def _lost(records: pd.DataFrame) -> pd.DataFrame:
    """Records in which nothing found is where a rock is."""
    fed = missed_all(records)
    return fed.assign(common_px=np.where(fed["status"] == "view", 0.0, np.nan))


FEEDS = Feeds(
    oracle=_oracle,
    shuffled=lambda records, _rng: _lost(records),
    mixed=lambda records, _claims, _rng: _lost(records),
)
