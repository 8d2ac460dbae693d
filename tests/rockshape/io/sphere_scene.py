"""A sphere on a plane before a camera, whose range the format tests write and measure.

The sphere of radius 0.15 m lies 1.5 m before the camera, on a plane.
"""

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import cv2
import numpy as np

import rockshape
from rockshape.measurement import Measurement
from tests import solids

CAMERA = {"fx": 500.0, "fy": 500.0, "cx": 159.5, "cy": 119.5, "width": 320, "height": 240}
RADIUS_M = 0.15


@dataclass(frozen=True, eq=False)
class Scene:
    """Points and depth of the scene, and the sphere's pixels."""

    points_m: np.ndarray  # (240, 320, 3) float32
    labels: np.ndarray

    @property
    def depth_m(self) -> np.ndarray:
        """Z-depth (240, 320)."""
        return self.points_m[..., 2]

    @property
    def distance_m(self) -> np.ndarray:
        """Length along the ray (240, 320)."""
        return np.linalg.norm(self.points_m.astype(np.float64), axis=-1)

    @property
    def image(self) -> np.ndarray:
        """A picture of it (240, 320)."""
        return np.where(self.labels > 0, 200, 90).astype(np.uint8)


@cache
def sphere_scene() -> Scene:
    """The scene, made once."""
    sphere = solids.ellipsoid_range(
        solids.CAMERA,
        centre_m=np.array([0.02, 0.15, 1.5]),
        half_axes_m=np.full(3, RADIUS_M),
        axes=np.eye(3),
    )
    plane = solids.plane_range(
        solids.CAMERA, normal=np.array([0.0, np.cos(0.6), np.sin(0.6)]), offset_m=1.1208
    )
    points = solids.nearest(sphere, plane)
    labels = (points[..., 2] == sphere[..., 2]).astype(np.uint8)
    points = points.astype(np.float32)
    for array in (points, labels):
        array.setflags(write=False)
    return Scene(points, labels)


def measure_files(folder: Path, **files: Path | str) -> Measurement:
    """Measurement of the scene's image and labels with range and camera of files."""
    scene = sphere_scene()
    cv2.imwrite(str(folder / "image.png"), scene.image)
    cv2.imwrite(str(folder / "labels.png"), scene.labels)
    observation = rockshape.read(folder / "image.png", labels=folder / "labels.png", **files)
    return rockshape.measure(observation)
