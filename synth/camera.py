"""The camera: presets, poses and projection, in OpenCV's frame (x right, y down, z forward)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Camera:
    """A pinhole camera; integer pixels are pixel centres, (0, 0) the upper-left one's."""

    fx: float  # pixels
    fy: float  # pixels
    cx: float  # pixels
    cy: float  # pixels
    width: int  # pixels
    height: int  # pixels

    def matrix(self) -> Floats:
        """Return K, (3, 3): pixels from camera coordinates over depth."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])

    def refined(self, factor: int) -> "Camera":
        """Return the camera with each pixel split into factor × factor, over the same field."""
        return Camera(
            fx=self.fx * factor,
            fy=self.fy * factor,
            cx=(self.cx + 0.5) * factor - 0.5,
            cy=(self.cy + 0.5) * factor - 0.5,
            width=self.width * factor,
            height=self.height * factor,
        )


@dataclass(frozen=True)
class Preset:
    """A flown camera and the distance at which rocks of the default size suit it."""

    camera: Camera
    distance_m: float


def _square_preset(*, size_px: int, pixel_mrad: float, distance_m: float) -> Preset:
    focal_px = 1000.0 / pixel_mrad
    centre_px = (size_px - 1) / 2.0
    camera = Camera(focal_px, focal_px, centre_px, centre_px, size_px, size_px)
    return Preset(camera=camera, distance_m=distance_m)


# Frame and central pixel's angle: Imager for Mars Pathfinder (Smith et al. 1997) and the
# engineering cameras of Mars Science Laboratory (Maki et al. 2012).
PRESETS = {
    "imp": _square_preset(size_px=256, pixel_mrad=0.98, distance_m=11.0),
    "msl-navcam": _square_preset(size_px=1024, pixel_mrad=0.82, distance_m=4.5),
}


@dataclass(frozen=True, eq=False)
class Pose:
    """Where a camera stands: camera = world_to_camera · world + translation_m."""

    world_to_camera: Floats  # (3, 3) rotation
    translation_m: Floats  # (3,)

    def position_m(self) -> Floats:
        """Return the camera's centre in the world, (3,)."""
        return np.asarray(-self.world_to_camera.T @ self.translation_m)

    def camera_points_m(self, world_points_m: Floats) -> Floats:
        """Return world points, (..., 3), in the camera's frame."""
        return np.asarray(world_points_m @ self.world_to_camera.T + self.translation_m)


def look_at(position_m: Floats, target_m: Floats) -> Pose:
    """Return the pose at a position that has the target on its axis and the horizon level.

    Straight up or down the horizon is undefined; the image's right is then the world's x.
    """
    forward = target_m - position_m
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    length = np.linalg.norm(right)
    right = right / length if length > 1e-12 else np.array([1.0, 0.0, 0.0])
    world_to_camera = np.stack([right, np.cross(forward, right), forward])
    return Pose(world_to_camera=world_to_camera, translation_m=-world_to_camera @ position_m)


def ring(*, count: int, distance_m: float, elevation_rad: float, start_rad: float) -> list[Pose]:
    """Return `count` poses evenly round the vertical through the origin, all looking at it."""
    azimuths_rad = start_rad + 2.0 * np.pi * np.arange(count) / count
    level_m = distance_m * np.cos(elevation_rad)
    height_m = distance_m * np.sin(elevation_rad)
    return [
        look_at(
            np.array([level_m * np.cos(azimuth), level_m * np.sin(azimuth), height_m]), np.zeros(3)
        )
        for azimuth in azimuths_rad
    ]


def project(camera: Camera, points_m: Floats) -> Floats:
    """Return pixels (column, row), (..., 2), of camera-frame points (..., 3) in front of it."""
    depth_m = points_m[..., 2]
    column = camera.fx * points_m[..., 0] / depth_m + camera.cx
    row = camera.fy * points_m[..., 1] / depth_m + camera.cy
    return np.stack([column, row], axis=-1)
