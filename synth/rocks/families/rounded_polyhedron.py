"""Rounded polyhedra, polyhedron ⊕ ball."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from synth.arrays import Floats
from synth.errors import SpecError
from synth.progress import counted
from synth.rocks.family import Family, Make
from synth.rocks.polyhedron import Polyhedron, tangent_cuts
from synth.rocks.record import RockModel
from synth.rocks.rounded import UnsettledError, held_rock, hold_axes
from synth.spec.rocks import RocksSpec

_ATTEMPTS = 60


def _plan(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> Make:
    rounding = rng.uniform(*spec.rounding)
    ((body, radius_m),) = _held(spec, [(half_axes_m, rounding)], rng)
    return partial(held_rock, body, radius_m, rounding)


def _grade(
    spec: RocksSpec, targets: Sequence[tuple[Floats, float]], rng: np.random.Generator
) -> list[RockModel]:
    return [
        held_rock(body, radius_m, rounding)
        for (body, radius_m), (_, rounding) in zip(
            counted(_held(spec, targets, rng), "rocks"), targets, strict=True
        )
    ]


def _held(
    spec: RocksSpec, targets: Sequence[tuple[Floats, float]], rng: np.random.Generator
) -> list[tuple[Polyhedron, float]]:
    """One random polyhedron held to several half-axes and roundings, drawn until all hold.

    Raises:
        SpecError: no polyhedron that holds them was drawn.
    """
    for _ in range(_ATTEMPTS):
        cuts = int(rng.integers(spec.cuts[0], spec.cuts[1] + 1))
        polyhedron = tangent_cuts(targets[0][0], cuts=cuts, rng=rng)
        try:
            return [hold_axes(polyhedron, axes, rounding=k) for axes, k in targets]
        except UnsettledError:
            continue
    raise SpecError(
        f"rocks.rounding: expected values that hold the half-axes, found {list(spec.rounding)}"
    )


ROUNDED_POLYHEDRON = Family(
    "rounded-polyhedron", "polyhedra ⊕ ball", plan=_plan, grade=_grade, truth="exact"
)
