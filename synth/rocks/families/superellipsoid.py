"""Superellipsoids: from ellipsoid to box by two exponents."""

import numpy as np
from numpy.typing import NDArray

from synth.rocks.family import Family
from synth.rocks.record import RockModel
from synth.rocks.superellipsoid import superellipsoid
from synth.spec.rocks import RocksSpec


def _draw(spec: RocksSpec, half_axes_m: NDArray[np.float64], rng: np.random.Generator) -> RockModel:
    exponents = rng.uniform(*spec.exponents), rng.uniform(*spec.exponents)
    return superellipsoid(half_axes_m, exponents=exponents)


SUPERELLIPSOID = Family("superellipsoid", "superellipsoids", draw=_draw, truth="exact")
