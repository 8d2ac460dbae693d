"""Ray casting with Embree, for machines without OpenGL."""

from collections.abc import Iterator, Sequence

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from synth.camera import Camera, Pose
from synth.light import Body, Stage

_SKY = 0.75
_RAYS_AT_ONCE = 1 << 18


class EmbreeRenderer:
    """A stage as two Embree scenes: one that is measured, one that is seen, with the shadows.

    A ray's direction has z = 1 in the camera's frame, so its length to the hit is the z-depth.
    """

    def __init__(self, stage: Stage, camera: Camera) -> None:
        self._camera = camera
        self._bodies = [*stage.rocks, stage.ground]
        self._seen = self._bodies if stage.shadows is None else [*self._bodies, stage.shadows]
        self._measured_scene = _embree_scene(self._bodies)
        self._seen_scene = _embree_scene(self._seen)

    def measure(
        self, pose: Pose, limits_m: tuple[float, float], rocks: Sequence[int] | None
    ) -> tuple[NDArray[np.uint16], NDArray[np.float64]]:
        """See `Renderer.measure`."""
        ground = len(self._bodies) - 1
        if rocks is None:
            scene, names = self._measured_scene, np.arange(1, ground + 2, dtype=np.uint16)
            names[ground] = 0
        else:
            scene = _embree_scene([self._bodies[index] for index in rocks])
            names = np.array([index + 1 for index in rocks], dtype=np.uint16)
        shape = (self._camera.height, self._camera.width)
        labels = np.zeros(shape, dtype=np.uint16)
        depth_m = np.full(shape, np.nan)
        for rows, origins, directions in _rays(self._camera, pose):
            hits = scene.run(origins, directions, output=1)
            hit = (hits["primID"] >= 0) & (hits["tfar"] <= limits_m[1])
            band = (rows.stop - rows.start, self._camera.width)
            body = np.where(hit, hits["geomID"], 0)
            labels[rows] = np.where(hit, names[body], 0).reshape(band)
            depth_m[rows] = np.where(hit, hits["tfar"], np.nan).reshape(band)
        return labels, depth_m

    def paint(self, pose: Pose, limits_m: tuple[float, float], factor: int) -> NDArray[np.uint8]:
        """See `Renderer.paint`."""
        camera = self._camera.refined(factor)
        image = np.empty((camera.height, camera.width), dtype=np.uint8)
        for rows, origins, directions in _rays(camera, pose):
            hits = self._seen_scene.run(origins, directions, output=1)
            value = np.full(len(origins), _SKY, dtype=np.float32)
            near = hits["tfar"] <= limits_m[1]
            for index, body in enumerate(self._seen):
                here = near & (hits["primID"] >= 0) & (hits["geomID"] == index)
                value[here] = _interpolated(body, hits, here)
            image[rows] = np.rint(255.0 * value).reshape(rows.stop - rows.start, camera.width)
        return image


def _embree_scene(bodies: Sequence[Body]) -> EmbreeScene:
    scene = EmbreeScene()
    for body in bodies:
        TriangleMesh(
            scene, body.vertices_m.astype(np.float32), np.ascontiguousarray(body.faces, np.int32)
        )
    return scene


def _rays(
    camera: Camera, pose: Pose
) -> Iterator[tuple[slice, NDArray[np.float32], NDArray[np.float32]]]:
    """Yield bands of rows with the rays through their pixels: origins and directions (n, 3)."""
    columns = (np.arange(camera.width) - camera.cx) / camera.fx
    origin = pose.position_m().astype(np.float32)
    step = max(1, _RAYS_AT_ONCE // camera.width)
    for start in range(0, camera.height, step):
        rows = slice(start, min(start + step, camera.height))
        lines = (np.arange(rows.start, rows.stop) - camera.cy) / camera.fy
        across, down = np.meshgrid(columns, lines)
        ahead = np.stack([across, down, np.ones_like(across)], axis=-1).reshape(-1, 3)
        directions = (ahead @ pose.world_to_camera).astype(np.float32)
        yield rows, np.broadcast_to(origin, directions.shape).copy(), directions


def _interpolated(
    body: Body, hits: dict[str, NDArray[np.float32]], here: NDArray[np.bool_]
) -> NDArray[np.float32]:
    """Return the brightness at hits on a body: (1 − u − v) b₀ + u b₁ + v b₂."""
    corner = body.brightness[body.faces[hits["primID"][here]]]
    u, v = hits["u"][here], hits["v"][here]
    return np.asarray((1.0 - u - v) * corner[:, 0] + u * corner[:, 1] + v * corner[:, 2])
