"""Sizes and forms of a bed's grains."""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats
from synth.bed.relief.bodies import GrainBody
from synth.bed.relief.packing import Grain
from synth.spec.bed import MAX_GRAINS, GrainsSpec

_MANY = 64  # grains drawn at once
_WIDE, _WIDE_SPREADS = 93.0, 1.5  # percentile of a bed's wide grains; the same in spreads
_SHUFFLE = 0.9  # how far the order of dropping strays from that of falling width, in ln width


@dataclass(frozen=True)
class GrainLaw:
    """Sizes and number of a tile's grains."""

    log_median: float  # of the widths in px
    spread: float  # standard deviation of ln width
    cover: float  # area of all outlines over that of the ground

    def relief_px(self, spec: GrainsSpec) -> float:
        """Height of the highest grains over the lowest gaps, roughly."""
        if spec.distribution == "percentiles":
            shares, widths = np.array(spec.percentiles).T
            wide = float(np.exp(np.interp(_WIDE, shares, np.log(widths))))
        else:
            wide = float(np.exp(self.log_median + _WIDE_SPREADS * self.spread))
        return float(np.clip(wide, *spec.width_px)) * (0.5 + 0.5 * min(self.cover, 2.0))


def draw_law(spec: GrainsSpec, rng: np.random.Generator) -> GrainLaw:
    """Law of a tile, drawn from a spec's ranges."""
    low, high = np.log(spec.median_px)
    return GrainLaw(
        log_median=rng.uniform(low, high),
        spread=rng.uniform(*spec.spread),
        cover=rng.uniform(*spec.cover),
    )


def draw_widths_px(spec: GrainsSpec, count: int, rng: np.random.Generator, law: GrainLaw) -> Floats:
    """Widths of grains, (count,)."""
    ends = np.log(spec.width_px)
    if spec.distribution == "percentiles":
        shares, widths = np.array(spec.percentiles).T
        logs = np.interp(rng.uniform(0.0, 100.0, count), shares, np.log(widths))
        return np.asarray(np.exp(logs.clip(*ends)))
    logs = law.log_median + law.spread * rng.standard_normal(count)
    for _ in range(50):
        beyond = (logs < ends[0]) | (logs > ends[1])
        if not beyond.any():
            break
        logs[beyond] = law.log_median + law.spread * rng.standard_normal(int(beyond.sum()))
    return np.asarray(np.exp(logs.clip(*ends)))


def draw_grains(
    spec: GrainsSpec,
    law: GrainLaw,
    library: tuple[GrainBody, ...],
    area_px2: float,
    rng: np.random.Generator,
) -> list[Grain]:
    """Grains for a ground of some area, in the order in which they are dropped.

    Wide grains tend to come first: those that fall into the gaps between them are small.
    """
    cover = law.cover
    kinds = [str(kind) for kind in rng.permutation(spec.shapes)[: int(rng.integers(1, 4))]]
    stock = [body for body in library if body.kind in kinds] or list(library)
    grains: list[Grain] = []
    covered = 0.0
    limit = MAX_GRAINS if spec.count is None else spec.count
    while len(grains) < limit and (spec.count is not None or covered < cover * area_px2):
        for width in draw_widths_px(spec, _MANY, rng, law):
            grain = _drawn(spec, stock, float(width), rng)
            grains.append(grain)
            covered += grain.area_px2
            if len(grains) == limit or (spec.count is None and covered >= cover * area_px2):
                break
    ranks = np.log([grain.width_px for grain in grains]) + _SHUFFLE * rng.standard_normal(
        len(grains)
    )
    return [grains[index] for index in np.argsort(-ranks)]


def _drawn(
    spec: GrainsSpec, stock: list[GrainBody], width_px: float, rng: np.random.Generator
) -> Grain:
    body = stock[int(rng.integers(len(stock)))]
    one, two = rng.uniform(0.0, 2.0 * np.pi, 2)
    ratio = rng.uniform(*spec.axis_ratio)
    mirror = 1.0 if rng.uniform() < 0.5 else -1.0
    stretch = _turn(two) @ np.diag([1.0, ratio * mirror]) @ _turn(one)
    least = least_caliper(body.hull @ stretch.T)
    flat = rng.uniform(*spec.flatness) * (0.6 if body.kind == "slab" else 1.0)
    return Grain(
        body=body,
        stretch=stretch * (width_px / least),
        width_px=width_px,
        half_thickness_px=width_px * flat / 2.0,
        burial=rng.uniform(*spec.burial),
    )


def least_caliper(hull: Floats) -> float:
    """Least caliper of a convex polygon, (n, 2): one jaw lies along a side.

    Repeated corners do no harm.
    """
    sides = np.roll(hull, -1, axis=0) - hull
    lengths = np.sqrt(sides[:, 0] ** 2 + sides[:, 1] ** 2)
    lengths[lengths < 1e-9] = np.inf
    reaches = hull[:, :1] * (sides[:, 1] / lengths) - hull[:, 1:] * (sides[:, 0] / lengths)
    widths = reaches.max(axis=0) - reaches.min(axis=0)
    return float(widths[np.isfinite(lengths)].min())


def greatest_caliper(hull: Floats) -> float:
    """Greatest caliper of a convex polygon, (n, 2): between two corners."""
    across, down = hull[:, :1] - hull[:, 0], hull[:, 1:] - hull[:, 1]
    return float(np.sqrt((across * across + down * down).max()))


def _turn(angle: float) -> Floats:
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([[cosine, -sine], [sine, cosine]])
