"""Ray casting: bodies as one Embree scene, and rays from a camera through its pixels."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from synth.arrays import Singles
from synth.camera.camera import RenderCamera
from synth.camera.lens import undistorted
from synth.camera.pose import Pose
from synth.light.body import Body

Indices = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Hits:
    """First hits of rays on bodies."""

    body: Indices  # (n,), −1 where a ray meets none
    length: Singles  # (n,), in lengths of the ray's direction
    face: Indices  # (n,), number among all bodies' faces
    u: Singles  # (n,), the second corner's weight
    v: Singles  # (n,), the third corner's weight


class Surfaces:
    """Surfaces for ray casting. Embree counts in float32: keep scenes near the origin."""

    def __init__(self, bodies: Sequence[Body]) -> None:
        self._scene = EmbreeScene()
        for body in bodies:
            faces = np.ascontiguousarray(body.faces, np.int32)
            TriangleMesh(self._scene, body.vertices_m.astype(np.float32), faces)
        starts = np.cumsum([0, *(len(body.vertices_m) for body in bodies)])
        self._first_face = np.cumsum([0, *(len(body.faces) for body in bodies)])[:-1]
        self._corners = np.concatenate(
            [body.faces + start for body, start in zip(bodies, starts, strict=False)]
        )
        self._normals = np.concatenate([body.normals for body in bodies]).astype(np.float32)

    def trace(self, origins_m: Singles, directions: Singles) -> Hits:
        """First hits of rays, origins and directions (n, 3)."""
        found = self._scene.run(origins_m, directions, output=1)
        body = found["geomID"].astype(np.int64)
        body[found["primID"] < 0] = -1
        face = found["primID"] + self._first_face[np.maximum(body, 0)]
        return Hits(body=body, length=found["tfar"], face=face, u=found["u"], v=found["v"])

    def normals_at(self, hits: Hits, chosen: Indices) -> Singles:
        """Unit normals at some of the hits, (k, 3), linear between the corners'."""
        corners = self._normals[self._corners[hits.face[chosen]]]
        u, v = hits.u[chosen, None], hits.v[chosen, None]
        mean = (1.0 - u - v) * corners[:, 0] + u * corners[:, 1] + v * corners[:, 2]
        return np.asarray(mean / np.linalg.norm(mean, axis=1, keepdims=True))

    def blocked(self, origins_m: Singles, direction: Singles) -> NDArray[np.bool_]:
        """Mask of points (n, 3) that have a body in one direction (3,)."""
        rays = np.broadcast_to(direction, origins_m.shape).astype(np.float32)
        return np.asarray(self._scene.run(origins_m, rays, query="OCCLUDED") >= 0)


def directions(camera: RenderCamera, pose: Pose, columns: Singles, rows: Singles) -> Singles:
    """Rays through pixels in the world, shaped as columns and rows broadcast, and 3.

    Their z in the camera's frame is 1, so lengths along them are z-depths.
    """
    across, down = undistorted(
        camera, (columns - camera.cx) / camera.fx, (rows - camera.cy) / camera.fy
    )
    turn = pose.world_to_camera.astype(np.float32)
    across, down = across.astype(np.float32), down.astype(np.float32)
    return np.asarray(across[..., None] * turn[0] + (down[..., None] * turn[1] + turn[2]))
