"""Shape of outlines as a user reads it: calipers, axis ratio, angularity and roundness."""

from collections.abc import Collection
from dataclasses import replace

import pandas as pd

import rockshape
from rockshape import Instances, Observation

QUANTITIES = {  # columns of the records, by those of the table of a measurement
    "feret_min_px": "least_axis_px",
    "feret_max_px": "greatest_axis_px",
    "axis_ratio": "axis_ratio",
    "angularity_2d": "angularity_2d",
    "roundness": "roundness",
}
TRUE = "true_"  # begins a quantity's name as it is of the true outline


def shape_readings(
    observation: Observation, rocks: Instances, numbers: Collection[int]
) -> pd.DataFrame:
    """Readings of some rocks, a row each, by their number; NaN where a measure refuses.

    The axes are the least and the greatest Feret diameter, px.
    """
    chosen = replace(rocks, items=tuple(rock for rock in rocks if rock.id in numbers))
    if not len(chosen):
        return pd.DataFrame(columns=list(QUANTITIES.values()), dtype="float64")
    found = rockshape.measure(
        observation, labels=chosen, pieces="keep", method="robust", descriptors=True
    )
    table = found.to_frame().set_index("rock")
    return table[list(QUANTITIES)].rename(columns=QUANTITIES).astype("float64")
