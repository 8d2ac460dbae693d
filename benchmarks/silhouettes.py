"""Drawn shapes as pixels at any size, turned and shifted anyhow, for the 2-D benchmarks."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.shapes import Shape, shape_series
from synth.shapes.outline import axis_ratio

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]
TUNED_BELOW = 1_000  # seeds for tuning
REPORTED_FROM = 10_000
TURN_RAD = np.linspace(0, 2 * np.pi, 4000, endpoint=False)
CIRCLE = np.column_stack([np.cos(TURN_RAD), np.sin(TURN_RAD)])


@dataclass(frozen=True, eq=False)
class Silhouette:
    """A shape of a series, ready to be drawn at a size."""

    shape: Shape
    seed: int  # of its turn and shift

    def truth(self) -> dict[str, float]:
        """The exact outline's numbers."""
        long_px, short_px = self.shape.sides_px
        return {
            "roundness": self.shape.outline.roundness(),
            "axis_ratio": axis_ratio(self.shape.outline.outline_px()),
            "rectangle_ratio": short_px / long_px,
            "knob": self.shape.knob,
        }

    def mask(self, size_px: float) -> Mask:
        """The pixels inside at a size (the long side of the smallest rectangle)."""
        rng = np.random.default_rng([self.seed, round(size_px)])
        outline = self.shape.outline.outline_px() * size_px / self.shape.sides_px[0]
        return fill(turned(outline, rng.uniform(0, 2 * np.pi)) + rng.uniform(0, 1, 2))


def draw(series: str, *, seed: int, count: int | None = None) -> list[Silhouette]:
    """The shapes of a series in order."""
    rng = np.random.default_rng(seed)
    shapes = shape_series(series, count=count, rng=rng)
    return [Silhouette(shape, 1000 * seed + index) for index, shape in enumerate(shapes)]


def turned(points: Floats, angle_rad: float) -> Floats:
    """Points (n, 2) turned about the origin."""
    cosine, sine = np.cos(angle_rad), np.sin(angle_rad)
    return points @ np.array([[cosine, sine], [-sine, cosine]])


def fill(outline_px: Floats, *, margin: int = 3) -> Mask:
    """Pixels whose centres lie inside a closed polygon (n, 2), in a frame just larger than it.

    Each row toggles where a side crosses it.
    """
    start = outline_px - (np.floor(outline_px.min(axis=0)) - margin)
    end = np.roll(start, -1, axis=0)
    cols, rows = (np.ceil(start.max(axis=0)).astype(int) + margin + 1).tolist()
    first = np.ceil(np.minimum(start[:, 1], end[:, 1])).astype(int)
    count = np.ceil(np.maximum(start[:, 1], end[:, 1])).astype(int) - first
    side = np.repeat(np.arange(len(start)), count)
    row = first[side] + np.arange(len(side)) - np.repeat(np.cumsum(count) - count, count)
    share = (row - start[side, 1]) / (end[side, 1] - start[side, 1])
    x = start[side, 0] + share * (end[side, 0] - start[side, 0])
    toggles = np.zeros((rows, cols), dtype=np.int32)
    np.add.at(toggles, (row, np.ceil(x).astype(int)), 1)
    return np.asarray(toggles.cumsum(axis=1) % 2 == 1)


def over_turns(read: Callable[[Mask], float], outline_px: Floats, turns: int) -> Floats:
    """Return the values of an outline (n, 2), turned and shifted anew each time."""
    found = []
    for turn in range(turns):
        rng = np.random.default_rng(REPORTED_FROM + turn)
        found.append(read(fill(turned(outline_px, rng.uniform(0, 7)) + rng.uniform(0, 1, 2))))
    return np.array(found)
