"""Camera poses: where a camera stands and where it looks."""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats


@dataclass(frozen=True, eq=False)
class Pose:
    """Camera pose: camera = world_to_camera · world + translation_m."""

    world_to_camera: Floats  # (3, 3) rotation
    translation_m: Floats  # (3,)

    def position_m(self) -> Floats:
        """Camera's centre in the world, (3,)."""
        return np.asarray(-self.world_to_camera.T @ self.translation_m)

    def camera_points_m(self, world_points_m: Floats) -> Floats:
        """World points, (..., 3), in the camera's frame."""
        return np.asarray(world_points_m @ self.world_to_camera.T + self.translation_m)


def right_eye(pose: Pose, baseline_m: float) -> Pose:
    """Pose of a second, parallel camera, a baseline to the right of the first."""
    shift_m = np.array([baseline_m, 0.0, 0.0])
    return Pose(pose.world_to_camera, pose.translation_m - shift_m)


def look_at(position_m: Floats, target_m: Floats, *, roll_rad: float = 0.0) -> Pose:
    """Pose at a position that has the target on its axis, rolled from a level horizon.

    A roll turns the camera clockwise about its axis, so the image turns anticlockwise.
    Straight up or down the horizon is undefined; the image's right is then the world's x.
    """
    forward = target_m - position_m
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    length = np.linalg.norm(right)
    right = right / length if length > 1e-12 else np.array([1.0, 0.0, 0.0])
    world_to_camera = np.stack([right, np.cross(forward, right), forward])
    if roll_rad:
        cosine, sine = np.cos(roll_rad), np.sin(roll_rad)
        roll = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        world_to_camera = roll @ world_to_camera
    return Pose(world_to_camera=world_to_camera, translation_m=-world_to_camera @ position_m)
