"""Ray casting with Embree, for machines without OpenGL and for lenses that bend lines."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.light import Stage
from synth.light.rays import Surfaces, directions

_RAYS_AT_ONCE = 1 << 18


class EmbreeRenderer:
    """Embree renderer: a stage as the Embree scene that the painter has already."""

    def __init__(self, stage: Stage, camera: RenderCamera) -> None:
        self._stage, self._camera = stage, camera

    def measure(
        self,
        pose: Pose,
        limits_m: tuple[float, float],
        rocks: Sequence[int] | None,
    ) -> tuple[NDArray[np.uint16], NDArray[np.float64]]:
        """See `Renderer.measure`."""
        stage, camera = self._stage, self._camera
        if rocks is None:
            surfaces = stage.painter.surfaces
            names = np.zeros(len(stage.rocks) + len(stage.ground), dtype=np.uint16)
            names[: len(stage.rocks)] = np.arange(1, len(stage.rocks) + 1)
            first = len(stage.rocks) + 1
            things = np.arange(first, first + len(stage.things), dtype=np.uint16)
            names = np.concatenate([names, things])
        else:
            surfaces = Surfaces([stage.rocks[index] for index in rocks])
            names = np.array([index + 1 for index in rocks], dtype=np.uint16)
        labels = np.zeros((camera.height, camera.width), dtype=np.uint16)
        depth_m = np.full(labels.shape, np.nan)
        columns = np.arange(camera.width, dtype=np.float32)[None, :]
        eye_m = pose.position_m().astype(np.float32)
        step = max(1, _RAYS_AT_ONCE // camera.width)
        for start in range(0, camera.height, step):
            rows = np.arange(start, min(start + step, camera.height), dtype=np.float32)[:, None]
            rays = directions(camera, pose, columns, rows)
            band = (slice(start, start + len(rows)), slice(None))
            flat = rays.reshape(-1, 3)
            hits = surfaces.trace(np.broadcast_to(eye_m, flat.shape).copy(), flat)
            hit = (hits.body >= 0) & (hits.length <= limits_m[1])
            labels[band] = np.where(hit, names[hits.body], 0).reshape(rays.shape[:2])
            depth_m[band] = np.where(hit, hits.length, np.nan).reshape(rays.shape[:2])
        return labels, depth_m
