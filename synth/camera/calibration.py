"""Calibration error: cameras and poses as a dataset reports them."""

from dataclasses import replace

import numpy as np
from msgspec import UnsetType
from scipy.spatial.transform import Rotation

from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.spec import SceneSpec

_CAMERA, _POSE = 701, 702  # streams of random numbers


def calibrated(spec: SceneSpec) -> bool:
    """Whether what a dataset reports of its cameras has errors of calibration."""
    return not isinstance(spec.calibration, UnsetType)


def reported_camera(spec: SceneSpec, camera: RenderCamera) -> RenderCamera:
    """Camera that a dataset reports: f (1 + σ_f g), cx + σ_p g and cy + σ_p g."""
    calibration = spec.calibration
    if isinstance(calibration, UnsetType):
        return camera
    focal, right, down = np.random.default_rng([spec.seed, _CAMERA]).standard_normal(3)
    scale = 1.0 + calibration.focal * float(focal)
    return replace(
        camera,
        fx=scale * camera.fx,
        fy=scale * camera.fy,
        cx=camera.cx + calibration.principal_px * float(right),
        cy=camera.cy + calibration.principal_px * float(down),
    )


def reported_pose(spec: SceneSpec, pose: Pose, *, scene: int, view: int) -> Pose:
    """Pose that a dataset reports of a view: turned about the camera's place, and moved.

    The camera is turned by the rotation vector σ_t g about its own axes; its place moves by σ_s g
    along the world's. g are vectors of independent normal numbers.
    """
    calibration = spec.calibration
    if isinstance(calibration, UnsetType):
        return pose
    turn, shift = np.random.default_rng([spec.seed, _POSE, scene, view]).standard_normal((2, 3))
    turned = Rotation.from_rotvec(calibration.turn_deg * turn, degrees=True).as_matrix()
    world_to_camera = turned @ pose.world_to_camera
    place_m = pose.position_m() + calibration.shift_m * shift
    return Pose(world_to_camera, -world_to_camera @ place_m)
