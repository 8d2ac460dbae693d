"""Rounded polyhedra, polyhedron ⊕ ball."""

from collections.abc import Sequence

import numpy as np

from synth.arrays import Floats
from synth.errors import SpecError
from synth.progress import counted
from synth.rocks.family import Family
from synth.rocks.polyhedron import tangent_cuts
from synth.rocks.record import RockModel
from synth.rocks.rounded import UnsettledError, rounded_polyhedron
from synth.spec.rocks import RocksSpec

_ATTEMPTS = 60


def _draw(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> RockModel:
    return _grade(spec, [(half_axes_m, rng.uniform(*spec.rounding))], rng)[0]


def _grade(
    spec: RocksSpec, targets: Sequence[tuple[Floats, float]], rng: np.random.Generator
) -> list[RockModel]:
    """One random polyhedron with several half-axes and roundings, drawn until all hold.

    Raises:
        SpecError: no polyhedron that holds them was drawn.
    """
    for _ in range(_ATTEMPTS):
        cuts = int(rng.integers(spec.cuts[0], spec.cuts[1] + 1))
        polyhedron = tangent_cuts(targets[0][0], cuts=cuts, rng=rng)
        try:
            return [
                rounded_polyhedron(polyhedron, axes, rounding=k)
                for axes, k in counted(targets, "rocks")
            ]
        except UnsettledError:
            continue
    raise SpecError(
        f"rocks.rounding: expected values that hold the half-axes, found {list(spec.rounding)}"
    )


ROUNDED_POLYHEDRON = Family(
    "rounded-polyhedron", "polyhedra ⊕ ball", draw=_draw, grade=_grade, truth="exact"
)
