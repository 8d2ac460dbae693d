"""Ellipsoids."""

import numpy as np
from numpy.typing import NDArray

from synth.rocks.ellipsoid import ellipsoid
from synth.rocks.family import Family
from synth.rocks.record import RockModel
from synth.spec.rocks import RocksSpec


def draw_ellipsoid(
    _: RocksSpec, half_axes_m: NDArray[np.float64], __: np.random.Generator
) -> RockModel:
    """Solid ellipsoid with half-axes (3,), a >= b >= c."""
    return ellipsoid(half_axes_m)


ELLIPSOID = Family("ellipsoid", "ellipsoids", draw=draw_ellipsoid, truth="exact")
