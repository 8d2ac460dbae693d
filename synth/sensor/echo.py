"""Echo of a sensor's own light: range along the rays, and how much light comes back."""

from dataclasses import dataclass

import numpy as np

from synth.arrays import Floats
from synth.camera.camera import RenderCamera
from synth.camera.lens import undistorted
from synth.camera.projection import pixel_rays
from synth.light.rays import directions
from synth.sensor.sensor import SensorInput


@dataclass(frozen=True, eq=False)
class Echo:
    """Echo of each pixel."""

    range_m: Floats  # (rows, cols), along the ray, NaN where nothing is
    signal: Floats  # (rows, cols), ρ cos θ/r², r in metres: 1 for a white, facing surface at 1 m


def ray_lengths(camera: RenderCamera) -> Floats:
    """Length of each pixel's ray over its z-depth, (rows, cols)."""
    across, down = undistorted(camera, *np.broadcast_arrays(*pixel_rays(camera)))
    return np.asarray(np.sqrt(1.0 + across**2 + down**2), dtype=np.float64)


def echo_of(shot: SensorInput) -> Echo:
    """Echo of a view: a Lambertian surface's, of its mean albedo, lit from the camera."""
    camera, surfaces = shot.camera, shot.stage.painter.surfaces
    rows = np.arange(camera.height, dtype=np.float32)[:, None]
    columns = np.arange(camera.width, dtype=np.float32)[None, :]
    rays = directions(camera, shot.pose, columns, rows).reshape(-1, 3)
    eye_m = np.broadcast_to(shot.pose.position_m().astype(np.float32), rays.shape)
    hits = surfaces.trace(np.ascontiguousarray(eye_m), rays)
    there = np.flatnonzero(hits.body >= 0)
    stage = shot.stage
    bodies = (*stage.rocks, *stage.ground, *stage.things)
    albedo = np.array([body.albedo * body.painted_albedo for body in bodies])
    lengths = ray_lengths(camera)
    facing = np.zeros(lengths.size)
    towards = -(surfaces.normals_at(hits, there) * rays[there]).sum(axis=1)
    facing[there] = albedo[hits.body[there]] * np.maximum(towards, 0.0)
    range_m = shot.view.depth_m * lengths
    return Echo(
        range_m=range_m, signal=np.nan_to_num(facing.reshape(lengths.shape) / lengths / range_m**2)
    )
