"""The camera: presets, poses and projection, in OpenCV's frame (x right, y down, z forward)."""

from dataclasses import dataclass, replace

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
    """A flown camera, its stereo baseline and the distance at which default rocks suit it."""

    camera: Camera
    distance_m: float
    baseline_m: float | None = None  # from the left eye to the right one; None: one eye alone


def _preset(
    width_px: int, height_px: int, *, pixel_mrad: float, baseline_m: float, distance_m: float
) -> Preset:
    """Return a preset with square pixels and the principal point in the frame's middle."""
    focal_px = 1000.0 / pixel_mrad
    camera = Camera(
        fx=focal_px,
        fy=focal_px,
        cx=(width_px - 1) / 2.0,
        cy=(height_px - 1) / 2.0,
        width=width_px,
        height=height_px,
    )
    return Preset(camera=camera, distance_m=distance_m, baseline_m=baseline_m)


# Frame, central pixel's angle and baseline: Imager for Mars Pathfinder (Smith et al. 1997),
# Sojourner (Matijevic et al. 1997), Mars Exploration Rovers (Maki et al. 2003, Bell et al. 2003),
# Mars Science Laboratory (Maki et al. 2012), Mars 2020 (Maki et al. 2020). A fisheye is taken as
# the pinhole with its frame and its central pixel, so its field is narrower than the lens's.
PRESETS = {
    "imp": _preset(256, 256, pixel_mrad=0.98, baseline_m=0.150, distance_m=11.0),
    "sojourner": replace(
        _preset(768, 484, pixel_mrad=2.9, baseline_m=0.126, distance_m=2.5),
        camera=Camera(1000.0 / 2.9, 1000.0 / 3.4, 383.5, 241.5, 768, 484),
    ),
    "mer-navcam": _preset(1024, 1024, pixel_mrad=0.82, baseline_m=0.20, distance_m=4.5),
    "mer-hazcam": _preset(1024, 1024, pixel_mrad=2.1, baseline_m=0.10, distance_m=2.5),
    "mer-pancam": _preset(1024, 1024, pixel_mrad=0.28, baseline_m=0.30, distance_m=11.0),
    "msl-navcam": _preset(1024, 1024, pixel_mrad=0.82, baseline_m=0.424, distance_m=4.5),
    "m2020-navcam": _preset(5120, 3840, pixel_mrad=0.33, baseline_m=0.424, distance_m=4.5),
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


def right_eye(pose: Pose, baseline_m: float) -> Pose:
    """Return the pose of a second, parallel camera, a baseline to the right of the first."""
    shift_m = np.array([baseline_m, 0.0, 0.0])
    return Pose(pose.world_to_camera, pose.translation_m - shift_m)


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
