"""Finish of rocks: lithology and colour of their surface."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import msgspec
import numpy as np

from synth.arrays import Floats
from synth.spec.tints import LithologyName, TintsSpec


@dataclass(frozen=True)
class Lithology:
    """Rock type: its colour, and how bright it is beside others."""

    rgb: tuple[float, float, float]  # linear; the colour alone counts
    brightness: float  # times the rock's albedo


LITHOLOGIES: Mapping[LithologyName, Lithology] = MappingProxyType(
    {
        "grey": Lithology((1.0, 1.0, 1.0), 1.0),
        "basalt": Lithology((0.107, 0.103, 0.100), 0.45),
        "dusty": Lithology((0.33, 0.215, 0.12), 0.85),
        "red": Lithology((0.30, 0.15, 0.09), 0.6),
        "tan": Lithology((0.36, 0.29, 0.20), 1.0),
        "pale": Lithology((0.56, 0.54, 0.49), 1.3),
    }
)


@dataclass(frozen=True, eq=False)
class Finish:
    """Surface of one rock."""

    lithology: LithologyName = "grey"
    rgb: Floats = field(default_factory=lambda: np.ones(3))  # (3,), the colour alone counts
    brightness: float = 1.0  # times its albedo


def draw_finishes(
    spec: TintsSpec | msgspec.UnsetType, count: int, *, rng: np.random.Generator
) -> list[Finish]:
    """Surfaces of so many rocks; without tints all are grey."""
    if isinstance(spec, msgspec.UnsetType):
        return [Finish()] * count
    return [_finish(spec, rng) for _ in range(count)]


def _finish(spec: TintsSpec, rng: np.random.Generator) -> Finish:
    name = spec.lithologies[int(rng.integers(len(spec.lithologies)))]
    kind = LITHOLOGIES[name]
    warmth = spec.spread * rng.standard_normal()
    rgb = np.array(kind.rgb) * np.exp(warmth * np.array([0.5, 0.0, -0.5]))
    return Finish(lithology=name, rgb=rgb, brightness=kind.brightness)
