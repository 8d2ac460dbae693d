"""Judge of gardens: that of multi-view experiments, and rank correlations between measures."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd
from scipy import stats

from validation.arrays import Floats
from validation.kinds.garden.spec import GardenExperiment
from validation.kinds.multiview import judge as multiview
from validation.kinds.multiview.judge import FEEDS, claims, ranked_claims, view_claims
from validation.kinds.multiview.judge.detection import rock_numbers
from validation.peers import MeasureSpec
from validation.scores.score import Definition, Estimate, Key
from validation.scores.titles import column_of
from validation.statistics.interval import of_sample
from validation.statistics.weighted import ratio

__all__ = ["FEEDS", "claims", "definitions", "ranked_claims", "view_claims"]


class Couple(NamedTuple):
    """Two measures by the paper's column names; RHO of table 4 is said of these."""

    first: str
    second: str


COUPLES = (
    Couple("axis_ratio", "sphericity_2d"),
    Couple("ellipse_error_px2", "angularity_3d_per_m"),
    Couple("ellipsoid_error_m2", "angularity_3d_per_m"),
    Couple("angularity_2d_deg", "angularity_3d_per_m"),
)


def rho_key(experiment: str, method: str, couple: Couple) -> Key:
    """Score's key: both columns joined by a plus."""
    columns = (column_of(method, column) for column in couple)
    return Key(experiment, method, "", "+".join(columns), "rho")


def _rho(key: Key) -> Callable[[pd.DataFrame], Estimate]:
    first, second = key.measure.split("+")

    def compute(records: pd.DataFrame) -> Estimate:
        own = records[(records["experiment"] == key.experiment) & (records["method"] == key.method)]
        shown = own[(own["status"] == "matched") & own["eligible"].astype(bool)]
        shown = shown[np.isfinite(shown[[first, second]].to_numpy(np.float64)).all(axis=1)]
        if len(shown) < 3:
            return Estimate(float("nan"), len(shown))
        one, other = (stats.rankdata(shown[column].to_numpy()) for column in (first, second))
        rock, rocks = rock_numbers(shown, own)

        def rho(weights: Floats) -> Floats:
            own = weights[:, rock]
            own = np.where(np.count_nonzero(own, axis=1, keepdims=True) < 3, 0.0, own)
            total = own.sum(axis=1)
            x, y = (ranks - ratio(own @ ranks, total)[:, None] for ranks in (one, other))
            between, of_x, of_y = ((own * each).sum(axis=1) for each in (x * y, x * x, y * y))
            return ratio(between, np.sqrt(of_x * of_y))

        return Estimate(of_sample(rho, rocks), len(shown), rocks, rho)

    return compute


def correlations(experiment: GardenExperiment) -> tuple[Definition, ...]:
    """Spearman's ρ of the couples, by each method; an interval keeps the sample's ranks."""
    return tuple(
        Definition(
            key=(key := rho_key(experiment.name, method, couple)),
            title=f"{key.measure.replace('+', ' with ')}: Spearman's ρ over rock views",
            unit="1",
            counted="rock views",
            better="neither",
            compute=_rho(key),
        )
        for method in experiment.methods
        for couple in COUPLES
    )


def definitions(
    experiment: GardenExperiment, measures: Sequence[MeasureSpec]
) -> tuple[Definition, ...]:
    """Scores of rocks seen from several views, then how far measures go together."""
    return (*multiview.definitions(experiment, measures), *correlations(experiment))
