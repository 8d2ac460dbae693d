"""Closed forms that the tests measure: shapes on pixels, and surfaces seen from one side."""

import numpy as np
from numpy.typing import NDArray

from rockshape.camera.camera import Camera


def disc(radius: float, *, shift: tuple[float, float] = (0, 0)) -> NDArray[np.bool_]:
    """Pixels whose centres lie within a disc in the middle of a square frame."""
    return ellipse(radius, radius, shift=shift)


def ellipse(
    major: float, minor: float, *, turn_rad: float = 0.0, shift: tuple[float, float] = (0, 0)
) -> NDArray[np.bool_]:
    """Pixels whose centres lie within an ellipse near the middle of a square frame."""
    size = int(2 * major) + 9
    y, x = np.mgrid[:size, :size] - (size - 1) / 2
    x, y = x - shift[0], y - shift[1]
    u = x * np.cos(turn_rad) + y * np.sin(turn_rad)
    v = y * np.cos(turn_rad) - x * np.sin(turn_rad)
    return np.asarray((u / major) ** 2 + (v / minor) ** 2 <= 1)


def regular_polygon(sides: int, radius: float, *, points: int) -> NDArray[np.float64]:
    """Outline (points, 2) of a regular polygon, evenly spaced along its sides, clockwise."""
    turns = 2 * np.pi * np.arange(sides + 1) / sides
    corners = radius * np.column_stack([np.cos(turns), np.sin(turns)])
    along = np.arange(points) / points * sides
    side = along.astype(int)
    share = (along - side)[:, None]
    return corners[side] * (1 - share) + corners[side + 1] * share


def circle(radius: float, *, points: int) -> NDArray[np.float64]:
    """Outline (points, 2) of a circle."""
    turns = 2 * np.pi * np.arange(points) / points
    return radius * np.column_stack([np.cos(turns), np.sin(turns)])


CAMERA = Camera(fx=500.0, fy=500.0, cx=159.5, cy=119.5, width=320, height=240)


def rays(camera: Camera) -> NDArray[np.float64]:
    """Directions (rows, cols, 3) with z = 1 through the pixel centres."""
    return camera.unproject(np.ones(camera.shape))


def ellipsoid_range(
    camera: Camera,
    *,
    centre_m: NDArray[np.float64],
    half_axes_m: NDArray[np.float64],
    axes: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Points (rows, cols, 3) where the rays first meet an ellipsoid, NaN where they miss.

    axes (3, 3) has the ellipsoid's axes in rows. The root of |S A (t d - c)|² = 1.
    """
    into = axes / half_axes_m[:, None]
    direction = rays(camera) @ into.T
    origin = -(into @ centre_m)
    a = (direction**2).sum(-1)
    b = direction @ origin
    root = b**2 - a * (origin @ origin - 1)
    t = (-b - np.sqrt(np.where(root >= 0, root, np.nan))) / a
    return rays(camera) * t[..., None]


def plane_range(
    camera: Camera, *, normal: NDArray[np.float64], offset_m: float
) -> NDArray[np.float64]:
    """Points (rows, cols, 3) where the rays meet the plane normal . p = offset, in front only."""
    t = offset_m / (rays(camera) @ normal)
    return rays(camera) * np.where(t > 0, t, np.nan)[..., None]


def nearest(*ranges: NDArray[np.float64]) -> NDArray[np.float64]:
    """The nearer of several surfaces at each pixel, (rows, cols, 3)."""
    stack = np.stack(ranges)
    depth = np.where(np.isnan(stack[..., 2]), np.inf, stack[..., 2])
    choice = depth.argmin(axis=0)
    return np.take_along_axis(stack, choice[None, ..., None], axis=0)[0]
