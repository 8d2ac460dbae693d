"""Outlines of bodies in plan: gauges of blended half-planes, and the moments of polygons."""

from collections.abc import Callable

import numpy as np

from synth.arrays import Floats

Gauge = Callable[[Floats, Floats], Floats]

DIRECTIONS = 144  # corners of an outline's polygon
_HULL = 40  # most corners of the outline's hull that are kept
_LONGEST = 1.3  # greatest distance of an outline from its middle


def make_gauge(kind: str, rng: np.random.Generator) -> Gauge:
    """Gauge of a body's outline: homogeneous of degree 1 in places (x, y), 1 on the outline."""
    angular = kind in ("angular", "broken", "slab")
    count = int(rng.integers(5, 9)) if angular else int(rng.integers(9, 15))
    power = float(rng.uniform(7.0, 20.0)) if angular else float(rng.uniform(4.0, 8.0))
    turns = 2.0 * np.pi * (np.arange(count) + rng.uniform(-0.38, 0.38, count)) / count
    spread = 0.2 if angular else 0.11
    reach = np.exp(spread * rng.standard_normal(count)).clip(0.72, 1.3)
    amount = {"cobble": 0.018, "angular": 0.02, "slab": 0.028, "broken": 0.035, "lumpy": 0.045}[
        kind
    ]
    orders = np.arange(2, 12)
    waves = amount * rng.standard_normal(len(orders)) / (orders / 2.0) ** 1.25
    phases = rng.uniform(0.0, 2.0 * np.pi, len(orders))

    def gauge(x: Floats, y: Floats) -> Floats:
        total = np.zeros_like(x)
        for turn, distance in zip(turns, reach, strict=True):
            total += np.maximum((np.cos(turn) * x + np.sin(turn) * y) / distance, 0.0) ** power
        angle = np.arctan2(y, x)
        bend = np.zeros_like(angle)
        for wave, order, phase in zip(waves, orders, phases, strict=True):
            bend += wave * np.cos(order * angle + phase)
        return np.asarray(total ** (1.0 / power) * np.exp(-bend))

    angles = np.linspace(0.0, 2.0 * np.pi, DIRECTIONS, endpoint=False)
    longest = 1.0 / gauge(np.cos(angles), np.sin(angles)).min()
    return lambda x, y: gauge(x, y) * max(longest / _LONGEST, 1.0)


def moments(outline: Floats) -> tuple[float, Floats, Floats]:
    """Area, centroid and second central moments over the area of a polygon, anticlockwise."""
    nxt = np.roll(outline, -1, axis=0)
    cross = outline[:, 0] * nxt[:, 1] - outline[:, 1] * nxt[:, 0]
    area = cross.sum() / 2.0
    centroid = (cross[:, None] * (outline + nxt)).sum(axis=0) / (6.0 * area)
    pairs = (
        np.einsum("n,ni,nj->ij", cross, outline, outline)
        + np.einsum("n,ni,nj->ij", cross, nxt, nxt)
        + np.einsum("n,ni,nj->ij", cross, outline + nxt, outline + nxt)
    )
    return float(area), centroid, pairs / (24.0 * area) - np.outer(centroid, centroid)


def padded(hull: Floats) -> Floats:
    """Convex polygon of exactly 40 corners: the last repeated, or the flattest left out."""
    while len(hull) > _HULL:
        before, after = np.roll(hull, 1, axis=0), np.roll(hull, -1, axis=0)
        one, two = hull - before, after - hull
        hull = np.delete(hull, np.argmin(np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])), 0)
    return np.concatenate([hull, np.repeat(hull[-1:], _HULL - len(hull), axis=0)])
