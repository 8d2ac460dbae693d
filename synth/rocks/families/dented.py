"""Dented rocks: convex bodies with smooth hollows."""

from functools import partial

import numpy as np
from msgspec import Struct

from synth.arrays import Floats
from synth.rocks.family import Family, Make, own_options
from synth.rocks.star import Made, convex_core, fitted, star_rock
from synth.rocks.star.dents import DentCount, DentDepth, DentWidth, draw_dents
from synth.spec.limits import check_ranges
from synth.spec.rocks import Cuts, RocksSpec, Softness, Subdivisions

_SPREAD = 0.12  # deviation of the log of a face's distance


class DentedOptions(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Hollows of the rocks of the family `dented`."""

    cuts: tuple[Cuts, Cuts] = (9, 15)  # faces of the convex body
    softness: tuple[Softness, Softness] = (0.02, 0.08)  # edges' radius over the half size
    dents: tuple[DentCount, DentCount] = (40, 80)
    depth: tuple[DentDepth, DentDepth] = (0.12, 0.35)  # of the widest, over the radius there
    width_deg: tuple[DentWidth, DentWidth] = (6.0, 18.0)  # deviation of its bell, from within
    subdivisions: Subdivisions = 6  # 20 × 4^n facets

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        check_ranges(self, "cuts", "softness", "dents", "depth", "width_deg")


def make_dented(half_axes_m: Floats, options: DentedOptions, rng: np.random.Generator) -> Made:
    """Dented body with about the half-axes (3,)."""
    softness = rng.uniform(*options.softness)
    core = convex_core(
        cuts=int(rng.integers(options.cuts[0], options.cuts[1] + 1)),
        softness=softness,
        spread=_SPREAD,
        rng=rng,
    )
    surface = draw_dents(
        core, dents=options.dents, depth=options.depth, width_deg=options.width_deg, rng=rng
    )
    knobs = {"softness": softness, "dents": float(len(surface.depths))}
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
