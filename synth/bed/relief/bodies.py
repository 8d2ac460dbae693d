"""Library of bodies: rocks as the heights of their upper and lower sides over their outline.

A body is star-shaped in plan. Its gauge g (1 on the outline, 0 at the middle) blends the gauges of
half-planes, bent by waves of the direction; its outline is r(θ) = 1/g(θ) exactly. Its upper side is
a dome √(1 − g²) cut by blended planes, dented and lumpy, its lower side a plainer one. Stored are
g² and the heights over √(1 − g²), which vary so smoothly that they bear any magnification.
"""

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np

from synth.arrays import Floats, Singles
from synth.bed.relief.outline import DIRECTIONS, make_gauge, moments, padded
from synth.noise import fractal

SIDE = 96  # samples along a side of the stored square
REACH = 1.45  # half that side, in units in which outlines lie near 1
KINDS = ("cobble", "angular", "slab", "broken", "lumpy")
_EDGE = 0.93  # g at which heights beyond the outline are taken
_LEAST = 0.03  # least height over √(1 − g²)


@dataclass(frozen=True, eq=False)
class GrainBody:
    """Body of unit size: outline of mean radius near 1, upper side up to height 1 or so."""

    kind: str
    maps: Singles  # (SIDE, SIDE, 3): g², and the heights above and below over √(1 − g²)
    outline: Floats  # (n, 2), corners of the outline, x along columns
    hull: Floats  # (k, 2), of its convex hull
    area: float
    centroid: Floats  # (2,)
    covariance: Floats  # (2, 2), of the area
    roughness: float  # 0 smooth to 1 rough


@lru_cache(maxsize=8)
def body_library(seed: int, count: int) -> tuple[GrainBody, ...]:
    """Bodies of all kinds in turn, a function of the seed alone."""
    return tuple(
        make_body(KINDS[index % len(KINDS)], np.random.default_rng([seed, 11, index]))
        for index in range(count)
    )


def make_body(kind: str, rng: np.random.Generator) -> GrainBody:
    """Random body of a kind."""
    line = np.linspace(-REACH, REACH, SIDE)
    x, y = np.meshgrid(line, line)
    gauge_of = make_gauge(kind, rng)
    gauge = gauge_of(x, y)
    round_top = np.sqrt(np.maximum(1.0 - gauge**2, 0.0))
    blurred = fractal(SIDE, 3.4, rng, finest_px=9.0)
    above = _side(x, y, round_top, kind, rng)
    below = _side(x, y, round_top, "slab" if kind == "slab" else "cobble", rng)
    above = _weathered(above, (x, y), blurred, kind, rng)
    level = np.maximum(round_top, 0.15)
    maps = np.stack(
        [gauge**2, np.maximum(above / level, _LEAST), np.maximum(below / level, _LEAST)], axis=-1
    ).astype(np.float32)
    maps[..., 1:] = _continued(maps[..., 1:], x, y, gauge)
    angles = np.linspace(0.0, 2.0 * np.pi, DIRECTIONS, endpoint=False)
    rays = np.column_stack([np.cos(angles), np.sin(angles)])
    outline = rays / gauge_of(rays[:, 0], rays[:, 1])[:, None]
    area, centroid, covariance = moments(outline)
    hull = cv2.convexHull(outline.astype(np.float32))[:, 0].astype(np.float64)
    roughness = {"cobble": 0.25, "slab": 0.5, "lumpy": 0.7, "angular": 0.6, "broken": 0.8}[kind]
    return GrainBody(
        kind=kind,
        maps=maps,
        outline=outline,
        hull=padded(hull),
        area=area,
        centroid=centroid,
        covariance=covariance,
        roughness=float(np.clip(roughness * rng.uniform(0.4, 1.5), 0.0, 1.0)),
    )


def _side(x: Floats, y: Floats, dome: Floats, kind: str, rng: np.random.Generator) -> Floats:
    """Height of one side: the dome, blended with the planes that cut it."""
    count, depth, keen = {
        "cobble": (3, 0.07, 9.0),
        "lumpy": (4, 0.10, 9.0),
        "angular": (7, 0.20, 16.0),
        "broken": (5, 0.18, 18.0),
        "slab": (3, 0.10, 9.0),
    }[kind]
    heights = [dome ** rng.uniform(0.85, 1.1)]
    for _ in range(count):
        polar = np.deg2rad(rng.uniform(8.0, 62.0))
        azimuth = rng.uniform(0.0, 2.0 * np.pi)
        across = np.sin(polar) * (np.cos(azimuth) * x + np.sin(azimuth) * y)
        cut = 1.0 - depth * rng.uniform(0.2, 1.9)
        heights.append(np.maximum((cut - across) / np.cos(polar), 0.22 * dome))
    if kind == "slab":
        lean = rng.uniform(-0.12, 0.12, 2)
        heights.append(rng.uniform(0.45, 0.65) + lean[0] * x + lean[1] * y)
    stack = np.stack(heights)
    least = stack.min(axis=0)
    blended = least - np.log(np.exp(-keen * (stack - least)).sum(axis=0)) / keen
    return np.asarray(np.maximum(blended, 0.0))


def _weathered(
    height: Floats,
    places: tuple[Floats, Floats],
    noise: Singles,
    kind: str,
    rng: np.random.Generator,
) -> Floats:
    """Height with lumps, dents and a broken face."""
    x, y = places
    lumps = {"cobble": 0.015, "angular": 0.03, "slab": 0.03, "broken": 0.05, "lumpy": 0.06}[kind]
    height = height * (1.0 + lumps * rng.uniform(0.3, 1.6) * noise)
    for _ in range(int(rng.integers(0, 5 if kind == "lumpy" else 3))):
        place = rng.uniform(-0.75, 0.75, 2)
        width = rng.uniform(0.10, 0.34)
        bowl = np.exp(-((x - place[0]) ** 2 + (y - place[1]) ** 2) / (2.0 * width**2))
        height = height * (1.0 - rng.uniform(0.1, 0.55) * width * bowl)
    if kind == "broken":
        polar, azimuth = np.deg2rad(rng.uniform(15.0, 50.0)), rng.uniform(0.0, 2.0 * np.pi)
        across = np.sin(polar) * (np.cos(azimuth) * x + np.sin(azimuth) * y)
        face = (1.0 - rng.uniform(0.3, 0.6) - across) / np.cos(polar) + 0.02 * noise
        height = np.minimum(height, np.maximum(face, 0.3 * height))
    if kind == "slab" and rng.uniform() < 0.6:
        step = rng.uniform(0.06, 0.14)
        edge = (rng.standard_normal() * x + rng.standard_normal() * y) * 1.5 + 0.5 * noise
        lower = step / (1.0 + np.exp(-25.0 * (edge - rng.uniform(0.0, 1.0))))
        height = height - np.minimum(lower, 0.35 * height)
    return np.asarray(np.maximum(height, 0.0))


def _continued(maps: Singles, x: Floats, y: Floats, gauge: Floats) -> Singles:
    """Maps whose values beyond the outline are those just inside it, along the same ray."""
    shrink = np.minimum(_EDGE / np.maximum(gauge, 1e-9), 1.0)
    scale = (SIDE - 1) / (2.0 * REACH)
    columns, rows = (((part * shrink + REACH) * scale).astype(np.float32) for part in (x, y))
    inner = cv2.remap(maps, columns, rows, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(inner, dtype=np.float32)
