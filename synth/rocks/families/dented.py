"""Dented rocks: convex bodies with smooth hollows."""

from dataclasses import dataclass
from functools import partial
from typing import Annotated

import numpy as np
from msgspec import Meta, Struct

from synth.arrays import Floats, Ints
from synth.rocks.family import Family, Make, own_options
from synth.rocks.star import Made, StarSurface, convex_core, fitted, star_rock
from synth.spec.limits import check_ranges
from synth.spec.rocks import Cuts, RocksSpec, Softness, Subdivisions

_SPREAD = 0.12  # deviation of the log of a face's distance

Dents = Annotated[int, Meta(ge=0, le=100)]
Depth = Annotated[float, Meta(ge=0, le=0.5)]
Width = Annotated[float, Meta(ge=2, le=60)]


class DentedOptions(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Hollows of the rocks of the family `dented`."""

    cuts: tuple[Cuts, Cuts] = (9, 15)  # faces of the convex body
    softness: tuple[Softness, Softness] = (0.02, 0.08)  # edges' radius over the half size
    dents: tuple[Dents, Dents] = (40, 80)
    depth: tuple[Depth, Depth] = (
        0.12,
        0.35,
    )  # of the widest, over the radius there
    width_deg: tuple[Width, Width] = (6.0, 18.0)  # deviation of a dent's bell, seen from within
    subdivisions: Subdivisions = 6  # 20 × 4^n facets

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        check_ranges(self, "cuts", "softness", "dents", "depth", "width_deg")


@dataclass(frozen=True, eq=False)
class Dented:
    """Surface whose radius is Π (1 − δ_k exp(−θ_k²/2σ_k²)) times another's, θ_k from dent k."""

    surface: StarSurface
    middles: Floats  # (k, 3), unit vectors
    depths: Floats  # (k,), δ
    widths_rad: Floats  # (k,), σ

    def points(self, directions: Floats) -> tuple[Floats, Ints]:
        """Points (n, 3) of the surface and their parts (n,)."""
        points, parts = self.surface.points(directions)
        away_rad = np.arccos(np.clip(directions @ self.middles.T, -1.0, 1.0))
        bells = np.exp(-0.5 * (away_rad / self.widths_rad) ** 2)
        return points * (1.0 - self.depths * bells).prod(axis=1, keepdims=True), parts


def make_dented(half_axes_m: Floats, options: DentedOptions, rng: np.random.Generator) -> Made:
    """Dented body with about the half-axes (3,)."""
    softness = rng.uniform(*options.softness)
    core = convex_core(
        cuts=int(rng.integers(options.cuts[0], options.cuts[1] + 1)),
        softness=softness,
        spread=_SPREAD,
        rng=rng,
    )
    count = int(rng.integers(options.dents[0], options.dents[1] + 1))
    middles = rng.standard_normal((count, 3))
    widths = rng.uniform(*options.width_deg, size=count)
    surface = Dented(
        core,
        middles=middles / np.linalg.norm(middles, axis=1, keepdims=True),
        depths=rng.uniform(*options.depth, size=count) * widths / options.width_deg[1],
        widths_rad=np.radians(widths),
    )
    knobs = {"softness": softness, "dents": float(count)}
    return Made(fitted(surface, half_axes_m), knobs, smooth=True, has_edges=False)


def _plan(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> Make:
    options = own_options(spec, DentedOptions)
    return partial(
        star_rock,
        "dented",
        make_dented(half_axes_m, options, rng),
        longest_m=float(half_axes_m[0]),
        subdivisions=options.subdivisions,
    )


DENTED = Family(
    "dented", "convex rocks with hollows", plan=_plan, extended=True, options=DentedOptions
)
