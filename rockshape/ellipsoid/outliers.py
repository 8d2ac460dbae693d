"""Outliers among the points of a rock: flying pixels, spikes and far points off its ellipsoid."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rockshape.ellipsoid.constrained_fit import HeldEllipsoid
from rockshape.ellipsoid.half_axes import Ellipsoid
from rockshape.numerics.robust_scale import median_scale

CUT = 6.0  # robust standard deviations
MAX_SHARE = 0.1  # of the points: more of them are the rock's own shape
MAX_ROUNDS = 6
SAME = 1e-3  # of the points: what so few of them pull, the robust fit gives up
HIDDEN = -0.3  # cosine of the normal and the way to the camera below which no point can be seen

Fit = Callable[[NDArray[np.bool_], Ellipsoid | None], HeldEllipsoid | None]


def fit_without_outliers(
    points_m: NDArray[np.float64], fit: Fit
) -> tuple[HeldEllipsoid | None, NDArray[np.bool_]]:
    """Ellipsoid of the points (n, 3) that lie near its visible side, and which (n,) those are.

    The points are in the camera frame, the camera at the origin; fit takes which of them to use,
    and the ellipsoid of the round before to start from. A point is an outlier where its radial
    distance is more than six times the robust standard deviation 1.4826 median |e|, or where it
    lies on the far side. The fit is repeated without outliers, once at least where there are any,
    until all but a thousandth of the points stay what they are; where more than a tenth would be
    outliers, no point is one.
    """
    every = np.ones(len(points_m), dtype=np.bool_)
    first = found = fit(every, None)
    sound, settled = every, 0.0
    for _ in range(MAX_ROUNDS):
        if found is None:
            break
        distance = np.abs(found.ellipsoid.radial_distance_m(points_m))
        now = distance <= CUT * median_scale(distance)
        now &= facing(found.ellipsoid, points_m) > HIDDEN
        if (now != sound).mean() <= settled:
            return found, now
        if now.mean() < 1 - MAX_SHARE:
            return first, every
        sound, settled = now, SAME
        found = fit(sound, found.ellipsoid)
    return found, sound


def facing(ellipsoid: Ellipsoid, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Cosine (n,) of the ellipsoid's normal at points and the way from there to the camera."""
    normal = ellipsoid.to_sphere(points_m) / ellipsoid.half_axes_m @ ellipsoid.axes
    length = np.linalg.norm(normal, axis=1) * np.linalg.norm(points_m, axis=1)
    return np.asarray(-(normal * points_m).sum(axis=1) / np.maximum(length, 1e-300))
