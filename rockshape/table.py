"""The table: one row a rock."""

import dataclasses
from typing import TYPE_CHECKING

import numpy as np
import pandas as pd

from rockshape.measures import METHODS

if TYPE_CHECKING:
    from rockshape.measurement import Measurement, Rock
    from rockshape.segmentation import Found

PLACE = ("rock", "row", "col", "area_px", "width_px", "height_px", "truncated", "visible_fraction")
FLAGS = ("branch", "flags", "outline_sd_px")
AXES = ("axis_a_m", "axis_b_m", "axis_c_m")
# the descriptors' columns, by the fields of the record
DESCRIPTORS = {
    "area": "outline_area_px2",
    "perimeter": "perimeter_px",
    "equivalent_diameter": "equivalent_diameter_px",
    "feret_max": "feret_max_px",
    "feret_min": "feret_min_px",
    "aspect_ratio": "aspect_ratio",
    "circularity": "circularity",
    "solidity": "solidity",
    "convexity": "convexity",
    "rectangularity": "rectangularity",
}


def columns(method: str, *, descriptors: bool = False, flags: bool = False) -> tuple[str, ...]:
    """The table's columns for a method, in order, and after them those that are asked for."""
    measured = tuple(measure.column for measure in METHODS[method])
    described = tuple(DESCRIPTORS.values()) if descriptors else ()
    return (*PLACE, *AXES, *measured, "reason", *described, *(FLAGS if flags else ()))


def to_frame(measurement: "Measurement", *, flags: bool = False) -> pd.DataFrame:
    """A measurement as a table with the columns of `columns`, one row a rock.

    row and col are the centroid of the rock's pixels; axis_a_m >= axis_b_m >= axis_c_m are the
    half-axes of the fitted ellipsoid in metres. A value that cannot be measured is NaN, and
    `reason` says why. With `flags`, branch is `range`, `image` or `labels`, flags are separated by
    `; `, and outline_sd_px is NaN where the outline is the border of the rock's pixels.
    """
    names = columns(measurement.method, descriptors=measurement.described, flags=flags)
    told = {one.number: one for one in measurement.found}
    rows = [
        (*_row(rock), *(_found(told.get(rock.number)) if flags else ()))
        for rock in measurement.rocks
    ]
    frame = pd.DataFrame(rows, columns=list(names))
    return frame.astype(_types(names))


def _found(found: "Found | None") -> tuple[str, str, float]:
    """How a rock was found, as the columns of FLAGS."""
    if found is None:
        return "labels", "", np.nan
    sd_px = np.nan if found.outline is None else found.outline.sd_px
    return found.branch, "; ".join(found.flags), sd_px


def _row(rock: "Rock") -> tuple[object, ...]:
    place = (rock.number, *(getattr(rock, name) for name in PLACE[1:]))
    half_axes = [np.nan] * 3 if rock.ellipsoid is None else rock.ellipsoid.half_axes_m
    described = () if rock.descriptors is None else dataclasses.astuple(rock.descriptors)
    return (*place, *half_axes, *rock.values.values(), rock.reason, *described)


def _types(names: tuple[str, ...]) -> dict[str, str]:
    """The type of each column, so that an empty table has them too."""
    whole = dict.fromkeys(("rock", "area_px", "width_px", "height_px"), "int64")
    words = {name: "object" for name in ("reason", "branch", "flags") if name in names}
    return dict.fromkeys(names, "float64") | whole | {"truncated": "bool"} | words
