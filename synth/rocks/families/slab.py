"""Slabs: layered plates with broken sides and ledges."""

from dataclasses import dataclass
from functools import partial
from typing import Annotated

import numpy as np
from msgspec import Meta

from synth.arrays import Floats, Ints
from synth.rocks.family import Family, Make, own_options
from synth.rocks.star import Cuts, Made, Waves, draw_waves, fitted, star_rock
from synth.rocks.star.dents import DentOptions, with_dents
from synth.spec.limits import AxisRatio, check_ranges
from synth.spec.rocks import RocksSpec, Softness, Subdivisions

_TILT_RAD = 0.14  # deviation of a side from the vertical
_BED_TILT = 0.06  # of a bed from the level, radians
_OCTAVES = (1.6, 3.1, 6.3, 12.0)  # wave numbers of a face's undulation
_LOWEST, _BACK = 0.25, (0.06, 0.3)  # the first layer's top; how far sides of the next stand back
_FLUSH, _NEARLY = 0.45, 0.004  # share of the sides that hardly stand back, and how far

Layers = Annotated[int, Meta(ge=1, le=8)]
Sides = Annotated[int, Meta(ge=3, le=12)]
Wavy = Annotated[float, Meta(ge=0, le=0.1)]


class SlabOptions(DentOptions, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Layers and sides of the rocks of the family `slab`."""

    thickness: tuple[AxisRatio, AxisRatio] = (0.25, 0.5)  # c/b, in place of rocks.c_over_b
    layers: tuple[Layers, Layers] = (1, 3)
    sides: tuple[Sides, Sides] = (5, 8)
    softness: tuple[Softness, Softness] = (0.015, 0.05)  # edges' radius over the half size
    waviness: tuple[Wavy, Wavy] = (0.01, 0.03)  # RMS of a face's undulation over its distance
    subdivisions: Subdivisions = 6  # 20 × 4^n facets

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        super().__post_init__()
        check_ranges(self, "thickness", "layers", "sides", "softness", "waviness")


@dataclass(frozen=True, eq=False)
class Layered:
    """Union of bodies that all hold the origin, their planes turned and undulating alike.

    Plane i lies along w at its distance times 1 + height × waves_i(w).
    """

    layers: tuple[Cuts, ...]
    waves: tuple[Waves, ...]  # one for each plane
    height: float

    def points(self, directions: Floats) -> tuple[Floats, Ints]:
        """Points (n, 3) of the surface and their layers (n,)."""
        swell = np.ones((len(directions), len(self.waves)))
        ahead = directions @ self.layers[0].normals.T > 0.0
        for plane, waves in enumerate(self.waves):
            met = ahead[:, plane]
            swell[met, plane] += self.height * waves.value(directions[met])
        reaches = np.stack([layer.radii(directions, swell) for layer in self.layers])
        return directions * reaches.max(axis=0)[:, None], reaches.argmax(axis=0)


def make_slab(half_axes_m: Floats, options: SlabOptions, rng: np.random.Generator) -> Made:
    """Slab with about the half-axes (3,): each layer is as high as those below and narrower."""
    softness, height = rng.uniform(*options.softness), rng.uniform(*options.waviness)
    sides = int(rng.integers(options.sides[0], options.sides[1] + 1))
    count = int(rng.integers(options.layers[0], options.layers[1] + 1))
    turns_rad = 2.0 * np.pi * (np.arange(sides) + rng.uniform(-0.3, 0.3, size=sides)) / sides
    walls = np.column_stack([np.cos(turns_rad), np.sin(turns_rad), np.zeros(sides)])
    walls[:, 2] = _TILT_RAD * rng.standard_normal(sides)
    beds = np.column_stack([_BED_TILT * rng.standard_normal((2, 2)), [1.0, -1.0]])
    normals = np.concatenate([walls, beds])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    waves = tuple(draw_waves(_OCTAVES, rng=rng) for _ in normals)
    reach = rng.uniform(0.85, 1.15, size=sides)
    layers = []
    for top in np.linspace(_LOWEST, 1.0, count + 1)[1:]:
        distances = np.concatenate([reach, [top, 1.0]])
        layers.append(Cuts(normals, distances, steep=1.0 / softness))
        back = rng.uniform(*_BACK, size=sides)
        reach = reach - np.where(rng.uniform(size=sides) > _FLUSH, back, _NEARLY)
    dented, hollows = with_dents(Layered(tuple(layers), waves, height), options, rng)
    knobs = {
        "softness": softness,
        "waviness": height,
        "layers": float(count),
        "sides": float(sides),
    }
    return Made(fitted(dented, half_axes_m), knobs | hollows, smooth=height == 0.0, has_edges=True)


def _plan(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> Make:
    options = own_options(spec, SlabOptions)
    thin_m = half_axes_m.copy()
    thin_m[2] = half_axes_m[1] * rng.uniform(*options.thickness)
    return partial(
        star_rock,
        "slab",
        make_slab(thin_m, options, rng),
        longest_m=float(half_axes_m[0]),
        subdivisions=options.subdivisions,
    )


SLAB = Family("slab", "layered plates with ledges", plan=_plan, extended=True, options=SlabOptions)
