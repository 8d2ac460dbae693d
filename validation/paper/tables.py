"""Tables 1 to 5 of the paper, read from the CSV files of this folder."""

from dataclasses import dataclass
from importlib.resources import files

import numpy as np
import pandas as pd
from scipy import stats

from validation.statistics import Block

# Table number of each roundness-type measure, by our name for the measure.
CONSISTENCY_TABLES = {
    "angularity_2d_deg": 1,
    "ellipse_error_px2": 2,
    "angularity_3d_per_m": 3,
}


@dataclass(frozen=True)
class ConsistencyTable:
    """One of tables 1 to 3: the same three rocks measured from several views."""

    number: int
    views: tuple[int, ...]  # as numbered in figure 10; table 3 lacks view 2
    block: Block  # (views, rocks); truth falls from rock 1 (most angular) to rock 3


def _read(name: str) -> pd.DataFrame:
    with (files("validation.paper") / name).open(encoding="utf-8") as stream:
        return pd.read_csv(stream)


def consistency_table(number: int) -> ConsistencyTable:
    """Table 1 (2-D angularity), 2 (ellipse error, px²) or 3 (3-D angularity).

    Raises:
        ValueError: the number is not 1, 2 or 3.
    """
    if number not in CONSISTENCY_TABLES.values():
        raise ValueError(f"number: expected 1, 2 or 3, found {number}")
    frame = _read(f"table{number}.csv").set_index("view")
    values = frame.to_numpy(dtype=np.float64)
    truth = np.arange(values.shape[1], 0, -1, dtype=np.float64)
    return ConsistencyTable(
        number=number,
        views=tuple(int(view) for view in frame.index),
        block=Block(values=values, truth=truth),
    )


def garden_table() -> pd.DataFrame:
    """Table 4: seven measures of 38 rocks of the Martian Rock Garden, indexed by rock."""
    return _read("table4.csv").set_index("rock")


def garden_correlation(first: str, second: str) -> float:
    """Spearman's ρ between two columns of table 4."""
    frame = garden_table()
    return float(stats.spearmanr(frame[first], frame[second]).statistic)


GARDEN_COLUMNS = {  # of table 4, by our name for the paper's measure
    "axis_ratio": "eccentricity",
    "ellipse_error_px2": "ellipse_error",
    "sphericity_2d": "sphericity_2d",
    "angularity_2d_deg": "angularity_2d",
    "ellipsoid_error_m2": "ellipsoid_error",
    "sphericity_3d": "sphericity_3d",
    "angularity_3d_per_m": "angularity_3d",
}
GARDEN_TWICE = ((13, 18), (28, 33))  # Bamm-Bamm and Flat Top, each in two images


def garden_rank_move(column: str) -> float:
    """How far the rocks seen twice move in table 4, mean, as a share of its 38 places."""
    ranks = garden_table()[column].rank()
    moves = [abs(ranks[one] - ranks[other]) for one, other in GARDEN_TWICE]
    return float(np.mean(moves) / len(ranks))


def ranking_table() -> pd.Series:
    """Table 5: the 3-D angularity of the 38 rocks of table 4, from least to most."""
    return _read("table5.csv").set_index("rock")["angularity_3d"]
