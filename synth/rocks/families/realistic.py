"""Realistic rocks: broken from a bed, chipped, worn and rough."""

import numpy as np
from numpy.typing import NDArray

from synth.rocks.family import Family
from synth.rocks.realistic import Realism, realistic
from synth.rocks.record import RockModel
from synth.spec.rocks import RocksSpec


def _draw(spec: RocksSpec, half_axes_m: NDArray[np.float64], rng: np.random.Generator) -> RockModel:
    ranges = spec.realism
    realism = Realism(
        cuts=int(rng.integers(ranges.cuts[0], ranges.cuts[1] + 1)),
        chips=int(rng.integers(ranges.chips[0], ranges.chips[1] + 1)),
        slab=rng.uniform(*ranges.slab),
        abrasion=rng.uniform(*ranges.abrasion),
        waviness=rng.uniform(*ranges.waviness),
        relief_rms=rng.uniform(*ranges.relief_rms),
        relief_degrees=ranges.relief_degrees,
        subdivisions=ranges.subdivisions,
    )
    return realistic(half_axes_m, realism, rng=rng)


REALISTIC = Family("realistic", "broken, chipped and worn rocks", draw=_draw)
