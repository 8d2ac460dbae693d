"""Broken rocks: worn bodies with one to three fresh, rough fractures."""

from dataclasses import dataclass
from functools import partial
from typing import Annotated

import numpy as np
from msgspec import Meta

from synth.arrays import Floats, Ints
from synth.rocks.family import Family, Make, own_options
from synth.rocks.polyhedron import spread_normals
from synth.rocks.sphere import unit_sphere
from synth.rocks.star import Made, StarSurface, Waves, convex_core, draw_waves, fitted, star_rock
from synth.rocks.star.dents import DentOptions, with_dents
from synth.spec.limits import check_ranges
from synth.spec.rocks import RocksSpec, Softness, Subdivisions

_CUTS, _SPREAD = (9, 15), 0.1  # faces of the worn body
_OCTAVES = (2.0, 4.0, 8.0, 16.0)  # wave numbers of a fracture, over the half size
_FALL = 0.9
_AHEAD = 0.05  # cosine below which a direction never meets a fracture

Fractures = Annotated[int, Meta(ge=1, le=6)]
Left = Annotated[float, Meta(ge=0.15, le=1)]
Rough = Annotated[float, Meta(ge=0, le=0.1)]


class BrokenOptions(DentOptions, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Fractures of the rocks of the family `broken`."""

    softness: tuple[Softness, Softness] = (0.1, 0.25)  # worn edges' radius over the half size
    fractures: tuple[Fractures, Fractures] = (1, 3)
    left: tuple[Left, Left] = (0.3, 0.75)  # a fracture's distance, over the worn body's extent
    roughness: tuple[Rough, Rough] = (0.02, 0.05)  # RMS of a fracture over its distance
    subdivisions: Subdivisions = 6  # 20 × 4^n facets

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        super().__post_init__()
        check_ranges(self, "softness", "fractures", "left", "roughness")


@dataclass(frozen=True, eq=False)
class Broken:
    """Surface cut by rough planes, along a sharp edge.

    A plane at the distance h is met along w at h (1 + height × waves(w))/(n·w).
    """

    surface: StarSurface
    normals: Floats  # (k, 3)
    distances: Floats  # (k,)
    waves: tuple[Waves, ...]  # one for each plane
    height: float

    def points(self, directions: Floats) -> tuple[Floats, Ints]:
        """Points (n, 3) of the surface and their parts (n,): 0 the worn one, then the planes."""
        points, _ = self.surface.points(directions)
        reaches = [np.linalg.norm(points, axis=1)]
        for normal, distance, waves in zip(self.normals, self.distances, self.waves, strict=True):
            ahead = directions @ normal
            met = ahead > _AHEAD
            reach = np.full(len(directions), np.inf)
            rough = distance * (1.0 + self.height * waves.value(directions[met]))
            reach[met] = rough / ahead[met]
            reaches.append(reach)
        table = np.stack(reaches)
        parts = table.argmin(axis=0)
        return points * (table.min(axis=0) / table[0])[:, None], parts


def make_broken(half_axes_m: Floats, options: BrokenOptions, rng: np.random.Generator) -> Made:
    """Broken body with about the half-axes (3,)."""
    softness, height = rng.uniform(*options.softness), rng.uniform(*options.roughness)
    cuts = int(rng.integers(_CUTS[0], _CUTS[1] + 1))
    core = convex_core(cuts=cuts, softness=softness, spread=_SPREAD, rng=rng)
    count = int(rng.integers(options.fractures[0], options.fractures[1] + 1))
    normals = spread_normals(count, rng)
    extents = (core.points(unit_sphere(4)[0])[0] @ normals.T).max(axis=0)
    surface = Broken(
        core,
        normals=normals,
        distances=extents * rng.uniform(*options.left, size=count),
        waves=tuple(draw_waves(_OCTAVES, fall=_FALL, rng=rng) for _ in range(count)),
        height=height,
    )
    dented, hollows = with_dents(surface, options, rng)
    knobs = {"softness": softness, "fractures": float(count), "fracture_roughness": height}
    return Made(fitted(dented, half_axes_m), knobs | hollows, smooth=height == 0.0, has_edges=True)


def _plan(spec: RocksSpec, half_axes_m: Floats, rng: np.random.Generator) -> Make:
    options = own_options(spec, BrokenOptions)
    return partial(
        star_rock,
        "broken",
        make_broken(half_axes_m, options, rng),
        longest_m=float(half_axes_m[0]),
        subdivisions=options.subdivisions,
    )


BROKEN = Family(
    "broken", "worn rocks with fresh fractures", plan=_plan, extended=True, options=BrokenOptions
)
