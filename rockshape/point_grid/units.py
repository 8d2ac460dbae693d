"""Units of range, and the distances at which a scene can lie."""

import re
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.errors import InputError, did_you_mean

UNITS_M = {
    "km": 1e3,
    "m": 1.0,
    "dm": 1e-1,
    "cm": 1e-2,
    "mm": 1e-3,
    "um": 1e-6,
    "ft": 0.3048,
    "in": 0.0254,
}
MIN_RANGE_M = 0.01
MAX_RANGE_M = 200.0
FINE_STEP_M = 1e-5  # a step of integer range below this is rare but for a mistaken unit
MIN_FINE_RANGE_M = 0.1  # with such steps


@dataclass(frozen=True)
class RangeScale:
    """Length of one unit of the numbers that a range file holds, and who said so."""

    metres: float = 1.0
    said: str = "metres"  # for the messages
    meant: bool = False  # whether the user said it, so that any distance is believed


def parse_unit(text: str) -> RangeScale:
    """Scale of a unit's name, `mm`, or of a number of them, `0.25mm`.

    Raises: InputError for any other text.
    """
    metres = parse_length(text, what="range_unit (--range-unit)", example="0.25mm")
    return RangeScale(metres, f"--range-unit {text.strip()}", meant=True)


def parse_length(text: str, *, what: str, example: str) -> float:
    """Length, m, of a unit's name, `mm`, or of a number of them, `0.25mm`.

    Raises: InputError for any other text; `what` begins it.
    """
    parts = re.fullmatch(r"\s*([0-9.]+(?:[eE][-+]?[0-9]+)?)?\s*([a-zµμ]+)\s*", text)
    name = parts[2].replace("µ", "u").replace("μ", "u") if parts else text
    try:
        count = float(parts[1] or 1) if parts else 0.0
    except ValueError:
        count = 0.0
    if name not in UNITS_M or not (np.isfinite(count) and count > 0):
        raise InputError(
            f"{what}: expected {', '.join(UNITS_M)} or a number of them, "
            f"{example} say, found {text!r}{did_you_mean(name, UNITS_M)}"
        )
    return count * UNITS_M[name]


def check_distance(points_m: NDArray[np.float64], scale: RangeScale) -> None:
    """Check the median distance of points (rows, cols, 3) from their origin.

    Raises: InputError below 1 cm and above 200 m, unless the scale is meant: a camera's scene lies
    between, and the unit is probably another.
    """
    distances = np.sqrt((points_m**2).sum(axis=-1))
    known = distances[np.isfinite(distances)]
    if scale.meant or not len(known):
        return
    median = float(np.median(known))
    least = MIN_FINE_RANGE_M if scale.metres < FINE_STEP_M else MIN_RANGE_M
    if least <= median <= MAX_RANGE_M:
        return
    raise InputError(
        f"range: expected a median of {least:g} to {MAX_RANGE_M:g} m, "
        f"found {median:.3g} m with {scale.said}; {_advice(scale)}"
    )


def _advice(scale: RangeScale) -> str:
    if scale.said == "metres":
        return "name the unit with range_unit, --range-unit: mm, cm, m, ..."
    return (
        "depth_scale is mm a step, depth_scale_m metres a step; "
        f"--range-unit {scale.metres * 1e3:g}mm if it is meant"
    )
