"""Lumpy rocks: ellipsoids grown into one another."""

from dataclasses import dataclass
from functools import partial
from typing import Annotated

import numpy as np
from msgspec import Meta

from synth.arrays import Floats, Ints
from synth.rocks.family import Family, Make, own_options
from synth.rocks.star import Made, fitted, star_rock
from synth.rocks.star.dents import DentOptions, with_dents
from synth.spec.limits import check_ranges
from synth.spec.rocks import RocksSpec, Subdivisions

_RADII = (0.4, 1.0)  # of the lumps before they are stretched

Lumps = Annotated[int, Meta(ge=1, le=20)]
Offset = Annotated[float, Meta(ge=0, le=0.98)]
Blend = Annotated[float, Meta(ge=0.02, le=0.5)]


class LumpyOptions(DentOptions, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Lumps of the rocks of the family `lumpy`."""

    lumps: tuple[Lumps, Lumps] = (6, 12)
    offset: tuple[Offset, Offset] = (0.75, 0.95)  # of a lump's middle, over its radius
    blend: tuple[Blend, Blend] = (0.06, 0.14)  # how far valleys are filled, over the half size
    subdivisions: Subdivisions = 6  # 20 × 4^n facets

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        super().__post_init__()
        check_ranges(self, "lumps", "offset", "blend")


@dataclass(frozen=True, eq=False)
class LumpsUnion:
    """Soft union of balls that all hold the origin: r^p = Σ r_i^p over the balls' radii r_i.

    Along w the ball of radius ρ about c has r = c·w + √((c·w)² + ρ² − c²).
    """

    middles: Floats  # (k, 3)
    radii: Floats  # (k,), more than |middles|
    steep: float  # p

    def points(self, directions: Floats) -> tuple[Floats, Ints]:
        """Points (n, 3) of the surface, all of one part."""
        ahead = directions @ self.middles.T
        inside = self.radii**2 - (self.middles**2).sum(axis=1)
        reaches = ahead + np.sqrt(ahead**2 + inside)
        farthest = reaches.max(axis=1, keepdims=True)
        total = ((reaches / farthest) ** self.steep).sum(axis=1, keepdims=True)
        radii = farthest * total ** (1.0 / self.steep)
        return radii * directions, np.zeros(len(directions), dtype=np.int64)


def make_lumpy(half_axes_m: Floats, options: LumpyOptions, rng: np.random.Generator) -> Made:
    """Lumpy body with about the half-axes (3,)."""
    count = int(rng.integers(options.lumps[0], options.lumps[1] + 1))
    blend = rng.uniform(*options.blend)
    towards = rng.standard_normal((count, 3))
    towards /= np.linalg.norm(towards, axis=1, keepdims=True)
    radii = rng.uniform(*_RADII, size=count)
    offsets = radii * rng.uniform(*options.offset, size=count)
    surface = LumpsUnion(offsets[:, None] * towards, radii, steep=1.0 / blend)
    dented, hollows = with_dents(surface, options, rng)
    knobs = {"lumps": float(count), "blend": blend}
    return Made(fitted(dented, half_axes_m), knobs | hollows, smooth=True, has_edges=False)


def _plan(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> Make:
    options = own_options(spec, LumpyOptions)
    return partial(
        star_rock,
        "lumpy",
        make_lumpy(half_axes_m, options, rng),
        longest_m=float(half_axes_m[0]),
        subdivisions=options.subdivisions,
    )


LUMPY = Family(
    "lumpy", "ellipsoids grown into one another", plan=_plan, extended=True, options=LumpyOptions
)
