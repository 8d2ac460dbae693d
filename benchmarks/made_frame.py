"""Frames of any size with any number of rocks, drawn straight into the range.

A camera looks down on a plane; the rocks are domes with three lobes of relief, one in each cell of
a jittered grid. Beside a rendered scene such a frame costs nothing to make, and its rocks keep
their size in pixels or their number as asked.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera

PIXEL_M = 0.001  # on the ground
NOISE_M = 0.0003
SHARE = 0.33  # radius of a rock in sides of its cell


@dataclass(frozen=True, eq=False)
class Frame:
    """A frame's picture, range, camera and true labels."""

    image: NDArray[np.float32]
    points_m: NDArray[np.float64]
    camera: Camera
    labels: NDArray[np.int32]


def make_frame(*, side_px: int, rocks: int, radius_px: float | None = None, seed: int = 1) -> Frame:
    """A square frame; the rocks fill their cells unless their radius is given."""
    rng = np.random.default_rng(seed)
    cells = math.ceil(math.sqrt(rocks))
    cell = side_px / cells
    radius = SHARE * cell if radius_px is None else radius_px
    if radius > 0.45 * cell:
        raise ValueError(f"radius_px: expected at most {0.45 * cell:.0f}, found {radius_px}")
    height = rng.normal(0, NOISE_M, (side_px, side_px))
    labels = np.zeros((side_px, side_px), dtype=np.int32)
    for number in range(rocks):
        centre = (np.array(divmod(number, cells)) + 0.5) * cell
        centre += rng.uniform(-1, 1, 2) * max(0.0, 0.45 * cell - radius)
        _raise_rock(height, labels, centre, radius, number=number + 1, rng=rng)
    camera = Camera(
        fx=side_px,
        fy=side_px,
        cx=(side_px - 1) / 2,
        cy=(side_px - 1) / 2,
        width=side_px,
        height=side_px,
    )
    depth = side_px * PIXEL_M - height
    image = np.clip(0.4 + 20 * np.gradient(height, axis=1) / PIXEL_M / 20, 0, 1)
    return Frame(image.astype(np.float32), camera.unproject(depth), camera, labels)


def _raise_rock(
    height: NDArray[np.float64],
    labels: NDArray[np.int32],
    centre: NDArray[np.float64],
    radius: float,
    *,
    number: int,
    rng: np.random.Generator,
) -> None:
    """Add one dome to the height map, (rows, cols)."""
    low = np.maximum(np.floor(centre - radius).astype(int), 0)
    high = np.minimum(np.ceil(centre + radius).astype(int) + 1, height.shape)
    window = np.s_[low[0] : high[0], low[1] : high[1]]
    y, x = np.mgrid[window]
    y, x = y - centre[0], x - centre[1]
    turn, flat = rng.uniform(0, np.pi), rng.uniform(0.6, 1.0)
    u, v = x * np.cos(turn) + y * np.sin(turn), y * np.cos(turn) - x * np.sin(turn)
    around = np.arctan2(v, u)
    lobes = 1 - 0.12 * (1 + np.cos(3 * around + rng.uniform(0, 6)) * np.cos(around)) / 2
    level = np.hypot(u, v / flat) / (radius * lobes)
    dome = np.sqrt(np.maximum(1 - level**2, 0)) * radius * PIXEL_M * rng.uniform(0.5, 0.9)
    height[window] += dome
    labels[window][level < 1] = number
