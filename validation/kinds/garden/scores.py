"""What table 4 of the paper tells of a field of rocks: how far one measure goes with another."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import pandas as pd
from scipy import stats

from rockshape.method import methods
from validation.kinds.multiview.detection import rock_numbers
from validation.scores.score import Definition, Estimate, Key
from validation.scores.titles import REFERENCE
from validation.suite.experiments import YardExperiment


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


def is_garden(experiment: YardExperiment) -> bool:
    """Tell whether an experiment is a field seen frame by frame from one mast."""
    return experiment.scene.views.path == "pan"


def column_of(method: str, paper_column: str) -> str:
    """Return the method's column of the measure that the paper's method calls so."""
    titles = {measure.column: measure.title for measure in methods()[REFERENCE].measures}
    return next(m.column for m in methods()[method].measures if m.title == titles[paper_column])


def rho_key(experiment: str, method: str, couple: Couple) -> Key:
    """Return the score's key: both columns joined by a plus."""
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

        def rho(weights: np.typing.NDArray[np.float64]) -> float:
            weight = weights[rock]
            if np.count_nonzero(weight) < 3:
                return float("nan")
            table = np.cov(one, other, aweights=weight, bias=True)
            return float(table[0, 1] / np.sqrt(table[0, 0] * table[1, 1]))

        return Estimate(rho(np.ones(rocks)), len(shown), rocks, rho)

    return compute


def definitions(experiment: YardExperiment) -> tuple[Definition, ...]:
    """Return Spearman's ρ of the couples, by each method; an interval keeps the sample's ranks."""
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
