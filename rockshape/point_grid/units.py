"""Unit of range: metres, or what the caller says; implausible scenes are refused."""

import numpy as np

from rockshape.errors import InputError, unknown_name
from rockshape.numerics.arrays import Floats

RANGE_UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001}
NEAREST_M, FARTHEST_M = 0.01, 200.0  # median distances of scenes that rocks are measured in


def metres_per(unit: str | None) -> float:
    """Metres in a range unit; None is metres.

    Raises: InputError for an unknown unit.
    """
    if unit is None:
        return 1.0
    if unit not in RANGE_UNITS:
        raise unknown_name("range_unit", unit, RANGE_UNITS)
    return RANGE_UNITS[unit]


def check_scene_distance(points_m: Floats, *, unit: str | None) -> None:
    """Refuse points (rows, cols, 3) whose median distance no scene has, if no unit was stated.

    Raises: InputError for a median below 1 cm or above 200 m, unless a unit says it is meant.
    """
    if unit is not None:
        return
    distance = np.sqrt((points_m**2).sum(axis=-1))
    distance = distance[np.isfinite(distance)]
    if len(distance) == 0:
        return
    median_m = float(np.median(distance))
    if not NEAREST_M <= median_m <= FARTHEST_M:
        raise InputError(
            f"range: expected a median distance from {NEAREST_M:g} to {FARTHEST_M:g} m, found "
            f"{median_m:.3g} m; if it is meant, state its unit (range_unit, --range-unit)"
        )
