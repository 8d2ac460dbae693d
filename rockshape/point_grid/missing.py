"""Range values that are no measurement: zeros, infinities, saturated steps, no-data constants."""

from collections.abc import Collection, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]

FAR_VALUE = 1e6  # of z-depth, in any unit: renderers and sensors write 1e10 and the like for none
NEAR_VALUE = 1e-9  # likewise: none but for rounding
FAR_COORDINATE = 1e8  # of points, which may be given in a map's frame
SATURATED = 2**16 - 1  # steps, of a sensor of 16 bits, also after a conversion to another type
NO_DATA = (-32767.0, -32768.0, -9999.0, -99999.0, 32767.0, 65535.0, 99999.0)  # of coordinates
REPEATED = 0.01  # of all pixels: a point that so many share exactly stands for none
MIN_REPEATED = 100  # px


def missing_in_raster(values: NDArray[Any], *, no_data: Collection[float] = ()) -> dict[str, Mask]:
    """Pixels (rows, cols) of z-depth, distance or disparity without a measurement, by reason.

    no_data are the constants that the file itself names. A pixel has one reason; NaN is none, for
    it says itself that nothing was measured.
    """
    reasons = {"no-data value": _among(values, no_data)}
    if np.issubdtype(values.dtype, np.integer):
        greatest = np.iinfo(values.dtype).max
        reasons["saturated"] = (values == greatest) | (values == SATURATED)
    else:
        reasons["infinite"] = np.isinf(values)
        reasons["saturated"] = _among(values, [SATURATED / 10.0**power for power in range(5)])
        reasons["no-data value"] |= np.isfinite(values) & (np.abs(values) >= FAR_VALUE)
    reasons["zero"] = (values > -NEAR_VALUE) & (values < NEAR_VALUE)
    reasons["negative"] = values < 0
    return _first_reasons(reasons)


def missing_in_points(points: NDArray[Any], *, no_data: Collection[float] = ()) -> dict[str, Mask]:
    """Pixels (rows, cols) of points (rows, cols, 3) without a measurement, by reason.

    No surface is seen at the origin, nor at the same point by a hundredth of all pixels. A point
    that is NaN in every coordinate has no reason.
    """
    constants = [*no_data, *NO_DATA]
    reasons = {"zero": (points == 0).all(axis=-1)}
    if np.issubdtype(points.dtype, np.integer):
        limits = np.iinfo(points.dtype)
        reasons["saturated"] = ((points == limits.max) | (points == limits.min)).any(axis=-1)
    else:
        reasons["infinite"] = np.isinf(points).any(axis=-1)
        unknown = np.isnan(points)
        reasons["NaN in part"] = unknown.any(axis=-1) & ~unknown.all(axis=-1)
    far = np.abs(points.astype(np.float64)) >= FAR_COORDINATE
    reasons["no-data value"] = (_among(points, constants) | far).any(axis=-1)
    reasons["repeated"] = _repeated(points)
    return _first_reasons(reasons)


def _first_reasons(reasons: Mapping[str, Mask]) -> dict[str, Mask]:
    """Reasons that some pixel has, each pixel under its first one alone."""
    return dict(_told_apart(reasons))


def _told_apart(reasons: Mapping[str, Mask]) -> Iterator[tuple[str, Mask]]:
    taken = np.zeros(next(iter(reasons.values())).shape, dtype=bool)
    for reason, mask in reasons.items():
        fresh = mask & ~taken
        if fresh.any():
            yield reason, fresh
        taken |= mask


def _among(values: NDArray[np.generic], constants: Collection[float]) -> Mask:
    """Whether values are one of the constants, to the precision of their type."""
    found = np.zeros(values.shape, dtype=bool)
    for constant in constants:
        if np.issubdtype(values.dtype, np.integer):
            found |= values == constant
        else:
            found |= values == values.dtype.type(constant)
    return found


def _repeated(points: NDArray[np.generic]) -> Mask:
    """Pixels of any point that very many share; those of nothing lie side by side."""
    rows, cols = points.shape[:2]
    least = max(MIN_REPEATED, REPEATED * rows * cols)
    twins = (points[:, 1:] == points[:, :-1]).all(axis=-1)
    found = np.zeros((rows, cols), dtype=bool)
    if np.count_nonzero(twins) < least / 2:
        return found
    candidates, counts = np.unique(points[:, 1:][twins], axis=0, return_counts=True)
    for point in candidates[counts >= least / 2]:
        same = (points == point).all(axis=-1)
        if np.count_nonzero(same) >= least:
            found |= same
    return found
