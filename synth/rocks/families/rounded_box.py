"""Rounded boxes, box ⊕ ball."""

from collections.abc import Sequence

import numpy as np

from synth.arrays import Floats
from synth.progress import counted
from synth.rocks.family import Family
from synth.rocks.record import RockModel
from synth.rocks.rounded import rounded_box
from synth.spec.rocks import RocksSpec


def _draw(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> RockModel:
    return rounded_box(half_axes_m, rounding=rng.uniform(*spec.rounding))


def _grade(
    _: RocksSpec, targets: Sequence[tuple[Floats, float]], __: np.random.Generator
) -> list[RockModel]:
    return [
        rounded_box(half_axes_m, rounding=rounding)
        for half_axes_m, rounding in counted(targets, "rocks")
    ]


ROUNDED_BOX = Family("rounded-box", "boxes ⊕ ball", draw=_draw, grade=_grade, truth="exact")
