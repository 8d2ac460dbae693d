"""Finish of rocks: lithology, colour, veins and layers of their surface."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import msgspec
import numpy as np

from synth.arrays import Floats
from synth.spec.tints import LithologyName, TintsSpec

_MAX_VEINS = 4
_VEIN_REACH_M = 0.12  # a vein passes the rock's centroid within this
_WAVES = 3  # of different thickness, in a rock's layers


@dataclass(frozen=True)
class Lithology:
    """Rock type: its colour, and how bright it is beside others."""

    rgb: tuple[float, float, float]  # linear; the colour alone counts
    brightness: float  # times the rock's albedo


LITHOLOGIES: Mapping[LithologyName, Lithology] = MappingProxyType(
    {
        "grey": Lithology((1.0, 1.0, 1.0), 1.0),
        "basalt": Lithology((0.107, 0.103, 0.100), 0.45),
        "weathered": Lithology((0.23, 0.185, 0.145), 0.62),
        "dusty": Lithology((0.33, 0.215, 0.12), 0.85),
        "red": Lithology((0.30, 0.15, 0.09), 0.6),
        "tan": Lithology((0.36, 0.29, 0.20), 1.0),
        "pale": Lithology((0.56, 0.54, 0.49), 1.3),
    }
)


@dataclass(frozen=True, eq=False)
class Finish:
    """Surface of one rock. Veins and layers are planes of its own frame, wavy or of many depths."""

    lithology: LithologyName = "grey"
    rgb: Floats = field(default_factory=lambda: np.ones(3))  # (3,), the colour alone counts
    brightness: float = 1.0  # times its albedo
    veins: Floats = field(default_factory=lambda: np.empty((0, 5)))  # normal, place m, width m
    layers: Floats = field(default_factory=lambda: np.empty((0, 4)))  # waves rad/m, phase rad


def draw_finishes(
    spec: TintsSpec | msgspec.UnsetType, count: int, *, rng: np.random.Generator
) -> list[Finish]:
    """Surfaces of so many rocks; without tints all are grey."""
    if isinstance(spec, msgspec.UnsetType):
        return [Finish()] * count
    return [_finish(spec, rng) for _ in range(count)]


def draw_wetness(spec: TintsSpec | msgspec.UnsetType, *, rng: np.random.Generator) -> float:
    """Wetness of a scene; without tints it is dry."""
    return 0.0 if isinstance(spec, msgspec.UnsetType) else float(rng.uniform(*spec.wetness))


def _finish(spec: TintsSpec, rng: np.random.Generator) -> Finish:
    name = spec.lithologies[int(rng.integers(len(spec.lithologies)))]
    kind = LITHOLOGIES[name]
    warmth = spec.spread * rng.standard_normal()
    veined, layered = rng.uniform(size=2) < [spec.veins, spec.layers]
    veins, layers = _veins(spec, rng), _layers(spec, rng)
    return Finish(
        lithology=name,
        rgb=np.array(kind.rgb) * np.exp(warmth * np.array([0.5, 0.0, -0.5])),
        brightness=kind.brightness,
        veins=veins if veined else veins[:0],
        layers=layers if layered else layers[:0],
    )


def _veins(spec: TintsSpec, rng: np.random.Generator) -> Floats:
    """Planes n·p = d with a width, (k, 5)."""
    count = int(rng.integers(1, _MAX_VEINS + 1))
    normals = rng.standard_normal((count, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    places_m = rng.uniform(-_VEIN_REACH_M, _VEIN_REACH_M, count)
    return np.column_stack([normals, places_m, rng.uniform(*spec.vein_width_m, count)])


def _layers(spec: TintsSpec, rng: np.random.Generator) -> Floats:
    """Waves along one direction, (k, 4): radians per metre and phase."""
    normal = rng.standard_normal(3)
    normal /= np.linalg.norm(normal)
    waves = 2.0 * np.pi / rng.uniform(*spec.layer_m, _WAVES)
    return np.column_stack([waves[:, None] * normal, rng.uniform(0.0, 2.0 * np.pi, _WAVES)])
