"""Dents: smooth hollows in a star-shaped surface."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from msgspec import Meta, Struct

from synth.arrays import Floats, Ints
from synth.rocks.star.surface import StarSurface
from synth.spec.limits import check_ranges

DentCount = Annotated[int, Meta(ge=0, le=100)]
DentDepth = Annotated[float, Meta(ge=0, le=0.5)]
DentWidth = Annotated[float, Meta(ge=2, le=60)]


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


def draw_dents(
    surface: StarSurface,
    *,
    dents: tuple[int, int],
    depth: tuple[float, float],
    width_deg: tuple[float, float],
    rng: np.random.Generator,
) -> Dented:
    """Surface with dents, narrow ones shallower in proportion to their width."""
    count = int(rng.integers(dents[0], dents[1] + 1))
    middles = rng.standard_normal((count, 3))
    widths = rng.uniform(*width_deg, size=count)
    return Dented(
        surface,
        middles=middles / np.linalg.norm(middles, axis=1, keepdims=True),
        depths=rng.uniform(*depth, size=count) * widths / width_deg[1],
        widths_rad=np.radians(widths),
    )


class DentOptions(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Hollows laid on a family's surface, none by default."""

    dents: tuple[DentCount, DentCount] = (0, 0)
    dent_depth: tuple[DentDepth, DentDepth] = (0.12, 0.35)  # of the widest, over the radius there
    dent_width_deg: tuple[DentWidth, DentWidth] = (6.0, 18.0)  # deviation, seen from within

    def __post_init__(self) -> None:
        """Require ranges in rising order."""
        check_ranges(self, "dents", "dent_depth", "dent_width_deg")


def with_dents(
    surface: StarSurface, options: DentOptions, rng: np.random.Generator
) -> tuple[StarSurface, dict[str, float]]:
    """Surface with the dents that the options ask for, and their knobs; neither where none."""
    if not options.dents[1]:
        return surface, {}
    dented = draw_dents(
        surface,
        dents=options.dents,
        depth=options.dent_depth,
        width_deg=options.dent_width_deg,
        rng=rng,
    )
    return dented, {"dents": float(len(dented.depths))}
