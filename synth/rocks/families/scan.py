"""Scanned rocks: closed meshes from files."""

import numpy as np
from numpy.typing import NDArray

from synth.rocks.family import Family
from synth.rocks.record import RockModel
from synth.rocks.scan import scan
from synth.spec.rocks import RocksSpec


def _draw(spec: RocksSpec, half_axes_m: NDArray[np.float64], rng: np.random.Generator) -> RockModel:
    path = spec.scans[int(rng.integers(len(spec.scans)))]
    return scan(path, diameter_m=2.0 * float(half_axes_m[0]))


def _limits(spec: RocksSpec) -> None:
    if not spec.scans:
        raise ValueError("scans: expected mesh files for the family scan, found none")


SCAN = Family("scan", "scanned rocks from mesh files", draw=_draw, limits=_limits)
