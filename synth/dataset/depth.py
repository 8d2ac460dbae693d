"""Depth images: their scale, and depth to and from 16 bits."""

import numpy as np
from numpy.typing import NDArray

from synth.camera.trajectories import camera_distance_m, stations
from synth.spec import SceneSpec


def depth_scale_mm(spec: SceneSpec) -> float:
    """Scale of the depth images, millimetres a step, one for the whole dataset.

    Rocks lie on the ground within a known reach of the scene's centre. Seen along a level distance
    that far, and no lower than the centre, none can be deeper in any view than the centre's depth
    and the reach's share along the axis; that depth is spread over 65,535 steps, rounded up to a
    hundredth of a millimetre.
    """
    reach_m = camera_distance_m(spec.camera) + 2.0 * spec.rocks.diameter_m[1]
    if spec.population.kind != "count":
        reach_m = spec.population.radius_m + spec.population.d_max_m
    farthest_m = max(
        float(pose.translation_m[2] + reach_m * np.hypot(*pose.world_to_camera[2, :2]))
        for pose in stations(spec.camera, spec.views)
    )
    return float(np.ceil(1000.0 * farthest_m / 65535.0 * 100.0) / 100.0)


def encode_depth(depth_m: NDArray[np.float64], scale_mm: float) -> NDArray[np.uint16]:
    """Depth image in steps of scale_mm, 0 where nothing is or where 16 bits do not reach."""
    steps = np.rint(np.nan_to_num(depth_m, nan=0.0) * 1000.0 / scale_mm)
    return np.where((steps >= 0) & (steps <= 65535), steps, 0).astype(np.uint16)


def decode_depth(depth: NDArray[np.uint16], scale_mm: float) -> NDArray[np.float64]:
    """Depth in metres, NaN where nothing was measured, as a reader of the depth image has it."""
    depth_m = depth.astype(np.float64) * (scale_mm / 1000)
    depth_m[depth == 0] = np.nan
    return depth_m
