"""Validity of range values: which pixels were measured, and why the others have no point."""

from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rockshape.numerics.arrays import Floats

Validity = NDArray[np.uint8]
"""Why each pixel (rows, cols) has no point: values of `PointStatus`."""


class PointStatus(IntEnum):
    """What is known of a pixel's point."""

    MEASURED = 0
    UNMEASURED = 1  # NaN, an infinity, (0, 0, 0), or z-depth of 0 or less
    SENTINEL = 2  # a nodata tag's value, a missing constant, a saturated step
    FLYING = 3  # between two surfaces, where a pixel's footprint saw both


def point_status(range_m: NDArray[Any], sentinels: tuple[float, ...] = ()) -> Validity:
    """Status (rows, cols) of each pixel of z-depth (rows, cols) or points (rows, cols, 3).

    A point with any coordinate NaN or infinite, and (0, 0, 0), is not measured; nor is z-depth of 0
    or less. sentinels are values in the array's own unit, other than 0, that stand for no
    measurement in whichever coordinate they appear. Any real type will do.
    """
    grid = range_m if range_m.ndim == 3 else range_m[..., None]
    known = np.isfinite(grid).all(axis=-1)
    known &= (grid != 0).any(axis=-1) if range_m.ndim == 3 else grid[..., 0] > 0
    status = np.where(known, PointStatus.MEASURED, PointStatus.UNMEASURED).astype(np.uint8)
    for value in sentinels:
        status[(grid == value).any(axis=-1)] = PointStatus.SENTINEL
    return status


def without_invalid(range_m: Floats, status: Validity) -> Floats:
    """Copy of z-depth (rows, cols) or points (rows, cols, 3) with NaN wherever none is measured."""
    return np.where(
        (status == PointStatus.MEASURED).reshape(*status.shape, *[1] * (range_m.ndim - 2)),
        range_m,
        np.nan,
    )
