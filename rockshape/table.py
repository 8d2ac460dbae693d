"""The table: one row a rock."""

import numpy as np
import pandas as pd

from rockshape.measures import METHODS
from rockshape.pipeline import Measurement

PLACE = ("rock", "row", "col", "area_px", "width_px", "height_px", "truncated", "visible_fraction")
AXES = ("axis_a_m", "axis_b_m", "axis_c_m")


def columns(method: str) -> tuple[str, ...]:
    """The table's columns for a method, in order."""
    return (*PLACE, *AXES, *(measure.column for measure in METHODS[method]), "reason")


def to_frame(measurement: Measurement) -> pd.DataFrame:
    """A measurement as a table with the columns of `columns`, one row a rock.

    row and col are the centroid of the rock's pixels; axis_a_m >= axis_b_m >= axis_c_m are the
    half-axes of the fitted ellipsoid in metres. A value that cannot be measured is NaN, and
    `reason` says why.
    """
    rows = []
    for rock in measurement.rocks:
        half_axes = [np.nan] * 3 if rock.ellipsoid is None else rock.ellipsoid.half_axes_m
        place = (rock.number, *(getattr(rock, name) for name in PLACE[1:]))
        rows.append((*place, *half_axes, *rock.values.values(), rock.reason))
    frame = pd.DataFrame(rows, columns=list(columns(measurement.method)))
    return frame.astype(_types(measurement.method))


def _types(method: str) -> dict[str, str]:
    """The type of each column, so that an empty table has them too."""
    whole = dict.fromkeys(("rock", "area_px", "width_px", "height_px"), "int64")
    rest = dict.fromkeys(columns(method), "float64")
    return rest | whole | {"truncated": "bool", "reason": "object"}
