"""Vesicular rocks: pitted by bubbles of many sizes."""

from dataclasses import dataclass
from functools import partial
from typing import Annotated

import numpy as np
from msgspec import Meta

from synth.arrays import Floats, Ints
from synth.rocks.family import Family, Make, own_options
from synth.rocks.star import Made, StarSurface, convex_core, fitted, star_rock
from synth.rocks.star.dents import DentOptions, with_dents
from synth.spec.limits import Fraction, check_ranges
from synth.spec.rocks import RocksSpec, Softness, Subdivisions

_CUTS, _SPREAD = (9, 15), 0.12  # faces of the body
_MOST = 2000  # pits

Radius = Annotated[float, Meta(ge=0.02, le=0.5)]
Power = Annotated[float, Meta(ge=1.1, le=6)]


class VesicularOptions(DentOptions, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Pits of the rocks of the family `vesicular`."""

    softness: tuple[Softness, Softness] = (0.03, 0.1)  # edges' radius over the half size
    porosity: tuple[Fraction, Fraction] = (0.1, 0.4)  # the pits' discs over the surface
    pit_radius: tuple[Radius, Radius] = (0.05, 0.2)  # smallest and largest, over (abc)^(1/3)
    power: Power = 3.0  # radii ρ have the density ρ^-power
    depth: tuple[Fraction, Fraction] = (0.5, 1.0)  # of a pit, over its radius
    subdivisions: Subdivisions = 6  # 20 × 4^n facets

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        super().__post_init__()
        check_ranges(self, "softness", "porosity", "pit_radius", "depth")


@dataclass(frozen=True, eq=False)
class Pitted:
    """Surface less balls; what a ray meets of the balls first is the pits' floor.

    A ball of radius ρ about c is entered along w at c·w − √((c·w)² + ρ² − c²).
    """

    surface: StarSurface
    middles: Floats  # (k, 3)
    radii: Floats  # (k,)

    def points(self, directions: Floats) -> tuple[Floats, Ints]:
        """Points (n, 3) of the surface and their parts (n,): 0 the old one, then the pits."""
        points, _ = self.surface.points(directions)
        before = np.linalg.norm(points, axis=1)
        rays = points / before[:, None]
        reaches, parts = before.copy(), np.zeros(len(rays), dtype=np.int64)
        for pit, (middle, radius) in enumerate(zip(self.middles, self.radii, strict=True)):
            square = float(middle @ middle)
            ahead = rays @ middle
            near = np.flatnonzero((ahead > 0.0) & (ahead**2 > square - radius**2))
            root = np.sqrt(ahead[near] ** 2 + radius**2 - square)
            entered = ahead[near] - root
            open_ = (entered < reaches[near]) & (ahead[near] + root > before[near])
            reaches[near[open_]] = entered[open_]
            parts[near[open_]] = pit + 1
        return rays * reaches[:, None], parts


def make_vesicular(
    half_axes_m: Floats, options: VesicularOptions, rng: np.random.Generator
) -> Made:
    """Vesicular body with about the half-axes (3,).

    A pit's ball stands so far out, √(R² + ρ²) at least over a surface of radius R, that rays from
    the middle meet all of its floor. The pits' discs are counted against a sphere's surface.
    """
    softness, porosity = rng.uniform(*options.softness), rng.uniform(*options.porosity)
    cuts = int(rng.integers(_CUTS[0], _CUTS[1] + 1))
    core = convex_core(cuts=cuts, softness=softness, spread=_SPREAD, rng=rng)
    dented, hollows = with_dents(core, options, rng)
    surface = fitted(dented, half_axes_m)
    size_m = float(np.cbrt(np.prod(half_axes_m)))
    radii_m = size_m * _pit_radii(porosity, options, rng)
    towards = rng.standard_normal((len(radii_m), 3))
    floor_m, _ = surface.points(towards / np.linalg.norm(towards, axis=1, keepdims=True))
    reach_m = np.linalg.norm(floor_m, axis=1)
    shallower_m = radii_m * (1.0 - rng.uniform(*options.depth, size=len(radii_m)))
    lifted_m = np.hypot(reach_m, radii_m) + shallower_m
    pitted = Pitted(surface, floor_m * (lifted_m / reach_m)[:, None], radii_m)
    knobs = {"softness": softness, "porosity": porosity, "pits": float(len(radii_m))}
    return Made(pitted, knobs | hollows, smooth=not len(radii_m), has_edges=True)


def _pit_radii(porosity: float, options: VesicularOptions, rng: np.random.Generator) -> Floats:
    """Radii of pits, over the size, drawn until their discs are the porosity's share of 4π."""
    low, high = (radius ** (1.0 - options.power) for radius in options.pit_radius)
    radii = rng.uniform(high, low, size=_MOST) ** (1.0 / (1.0 - options.power))
    return np.asarray(radii[np.cumsum(radii**2) / 4.0 <= porosity])


def _plan(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> Make:
    options = own_options(spec, VesicularOptions)
    return partial(
        star_rock,
        "vesicular",
        make_vesicular(half_axes_m, options, rng),
        longest_m=float(half_axes_m[0]),
        subdivisions=options.subdivisions,
    )


VESICULAR = Family(
    "vesicular", "rocks pitted by bubbles", plan=_plan, extended=True, options=VesicularOptions
)
