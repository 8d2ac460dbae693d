"""Sizes and forms of a bed's grains."""

import numpy as np
from numpy.typing import NDArray

from synth.bed.relief.bodies import GrainBody
from synth.bed.relief.packing import Grain
from synth.spec.bed import MAX_GRAINS, GrainsSpec

Floats = NDArray[np.float64]

_MANY = 64  # grains drawn at once
_SHUFFLE = 0.9  # how far the order of dropping strays from that of falling width, in ln width


def draw_widths_px(spec: GrainsSpec, count: int, rng: np.random.Generator, law: Floats) -> Floats:
    """Widths of grains, (count,): `law` has the tile's ln median and the spread."""
    ends = np.log(spec.width_px)
    if spec.distribution == "percentiles":
        shares, widths = np.array(spec.percentiles).T
        logs = np.interp(rng.uniform(0.0, 100.0, count), shares, np.log(widths))
        return np.asarray(np.exp(logs.clip(*ends)))
    logs = law[0] + law[1] * rng.standard_normal(count)
    for _ in range(50):
        beyond = (logs < ends[0]) | (logs > ends[1])
        if not beyond.any():
            break
        logs[beyond] = law[0] + law[1] * rng.standard_normal(int(beyond.sum()))
    return np.asarray(np.exp(logs.clip(*ends)))


def draw_grains(
    spec: GrainsSpec,
    library: tuple[GrainBody, ...],
    area_px2: float,
    rng: np.random.Generator,
) -> list[Grain]:
    """Grains for a ground of some area, in the order in which they are dropped.

    Wide grains tend to come first: those that fall into the gaps between them are small.
    """
    low, high = np.log(spec.median_px)
    law = np.array([rng.uniform(low, high), rng.uniform(*spec.spread)])
    cover = rng.uniform(*spec.cover)
    kinds = [str(kind) for kind in rng.permutation(spec.shapes)[: int(rng.integers(1, 4))]]
    stock = [body for body in library if body.kind in kinds] or list(library)
    grains: list[Grain] = []
    widths: list[float] = []
    covered = 0.0
    limit = MAX_GRAINS if spec.count is None else spec.count
    while len(grains) < limit and (spec.count is not None or covered < cover * area_px2):
        for width in draw_widths_px(spec, _MANY, rng, law):
            grain = _drawn(spec, stock, float(width), rng)
            grains.append(grain)
            widths.append(float(width))
            covered += grain.body.area * abs(np.linalg.det(grain.stretch))
            if len(grains) == limit or (spec.count is None and covered >= cover * area_px2):
                break
    ranks = np.log(widths or [1.0]) + _SHUFFLE * rng.standard_normal(max(len(widths), 1))
    return [grains[index] for index in np.argsort(-ranks)[: len(grains)]]


def _drawn(
    spec: GrainsSpec, stock: list[GrainBody], width_px: float, rng: np.random.Generator
) -> Grain:
    body = stock[int(rng.integers(len(stock)))]
    one, two = rng.uniform(0.0, 2.0 * np.pi, 2)
    ratio = rng.uniform(*spec.axis_ratio)
    mirror = 1.0 if rng.uniform() < 0.5 else -1.0
    stretch = _turn(two) @ np.diag([1.0, ratio * mirror]) @ _turn(one)
    least, _ = calipers(body.hull @ stretch.T)
    flat = rng.uniform(*spec.flatness) * (0.6 if body.kind == "slab" else 1.0)
    return Grain(
        body=body,
        stretch=stretch * (width_px / least),
        half_thickness_px=width_px * flat / 2.0,
        burial=rng.uniform(*spec.burial),
    )


def calipers(hull: Floats) -> tuple[float, float]:
    """Least and greatest caliper of a convex polygon, (n, 2); repeated corners do no harm.

    The least is met with one jaw along a side, the greatest between two corners.
    """
    sides = np.roll(hull, -1, axis=0) - hull
    lengths = np.hypot(sides[:, 0], sides[:, 1])
    real = lengths > 1e-9
    normals = np.column_stack([-sides[real, 1], sides[real, 0]]) / lengths[real, None]
    reaches = hull @ normals.T
    gaps = hull[:, None, :] - hull[None, :, :]
    return float(np.ptp(reaches, axis=0).min()), float(np.sqrt((gaps**2).sum(axis=-1).max()))


def _turn(angle: float) -> Floats:
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([[cosine, -sine], [sine, cosine]])
