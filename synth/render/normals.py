"""Normal map: the surface's unit normal at each pixel's centre."""

import numpy as np

from synth.arrays import Singles
from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.light import Stage
from synth.light.rays import directions

_RAYS_AT_ONCE = 1 << 18


def normal_map(stage: Stage, camera: RenderCamera, pose: Pose) -> Singles:
    """Unit normals, (rows, cols, 3), in the camera's frame; NaN where nothing is.

    They are those that the light is worked out with: linear between a mesh's vertices.
    """
    surfaces = stage.painter.surfaces
    normals = np.full((camera.height, camera.width, 3), np.nan, dtype=np.float32)
    columns = np.arange(camera.width, dtype=np.float32)[None, :]
    eye_m = pose.position_m().astype(np.float32)
    step = max(1, _RAYS_AT_ONCE // camera.width)
    for start in range(0, camera.height, step):
        rows = np.arange(start, min(start + step, camera.height), dtype=np.float32)[:, None]
        rays = directions(camera, pose, columns, rows).reshape(-1, 3)
        hits = surfaces.trace(np.broadcast_to(eye_m, rays.shape).copy(), rays)
        seen = np.flatnonzero(hits.body >= 0)
        band = normals[start : start + len(rows)].reshape(-1, 3)
        band[seen] = surfaces.normals_at(hits, seen) @ pose.world_to_camera.T.astype(np.float32)
    return normals
