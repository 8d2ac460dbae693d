"""Projection: pixels of points, and rays of pixels."""

import numpy as np

from synth.arrays import Floats
from synth.camera.camera import RenderCamera
from synth.camera.lens import distorted, undistorted


def project(camera: RenderCamera, points_m: Floats) -> Floats:
    """Projection: pixels (column, row), (..., 2), of camera-frame points (..., 3) ahead of it."""
    across = points_m[..., 0] / points_m[..., 2]
    down = points_m[..., 1] / points_m[..., 2]
    x, y = distorted(camera, across, down)
    return np.stack([camera.fx * x + camera.cx, camera.fy * y + camera.cy], axis=-1)


def pixel_rays(camera: RenderCamera) -> tuple[Floats, Floats]:
    """Pixel centres over the focal length, (1, cols) and (rows, 1)."""
    columns, rows = np.arange(camera.width)[None, :], np.arange(camera.height)[:, None]
    return (
        np.asarray((columns - camera.cx) / camera.fx, dtype=np.float64),
        np.asarray((rows - camera.cy) / camera.fy, dtype=np.float64),
    )


def border_rays(camera: RenderCamera) -> tuple[Floats, Floats, Floats, Floats]:
    """Rays (x/z, y/z), (n, 2), along the frame's left, top, right and bottom side."""
    columns = np.arange(camera.width + 1) - 0.5
    rows = np.arange(camera.height + 1) - 0.5
    left, right = np.full(len(rows), -0.5), np.full(len(rows), camera.width - 0.5)
    top, bottom = np.full(len(columns), -0.5), np.full(len(columns), camera.height - 0.5)
    sides = [(left, rows), (columns, top), (right, rows), (columns, bottom)]
    one, two, three, four = (
        np.column_stack(
            undistorted(camera, (column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy)
        ).astype(np.float64)
        for column, row in sides
    )
    return one, two, three, four
