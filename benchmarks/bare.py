"""Bare renderers: the libraries called directly for a picture, depth and labels of a view.

pyrender draws its own lit picture, one sun with shadows, at the supersampled pixels of the whole
frame; Embree casts the rays to those pixels and from what they hit to the sun. Neither has sky,
texture, photometric law or sensor. Depth and labels are those of the backend at the pixels.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from timing import timed

from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.light import Stage
from synth.light.photometry import towards_sun
from synth.light.rays import directions
from synth.render import open_renderer
from synth.render.view import depth_limits_m
from synth.spec import RendererName
from synth.spec.view import SunSpec

_ROWS = 128  # of the supersampled frame at once


class BareRenderer:
    """One stage, as its backend's library renders it."""

    def __init__(
        self, backend: RendererName, stage: Stage, camera: RenderCamera, factor: int
    ) -> None:
        self._stage, self._camera, self._fine = stage, camera, camera.refined(factor)
        self._plain = open_renderer(backend, stage, camera)
        self._geometry = open_renderer(backend, stage, self._fine)
        self._draw = self._cast if backend == "embree" else _gl_picture(stage, self._fine)

    def seconds(self, pose: Pose) -> tuple[float, float]:
        """Return processor seconds of a whole view, and of its geometry alone."""
        limits_m = depth_limits_m(self._stage, self._camera, pose)
        plain = timed(lambda: self._plain.measure(pose, limits_m, None)).cpu_s
        geometry = timed(lambda: self._geometry.measure(pose, limits_m, None)).cpu_s
        return plain + timed(lambda: self._draw(pose, limits_m)).cpu_s, plain + geometry

    def _cast(self, pose: Pose, _: tuple[float, float]) -> None:
        """Cast the rays of a picture, and those to the sun from where they end."""
        surfaces, camera = self._stage.painter.surfaces, self._fine
        sun = towards_sun(SunSpec()).astype(np.float32)
        eye_m = pose.position_m().astype(np.float32)
        columns = np.arange(camera.width, dtype=np.float32)[None, :]
        for start in range(0, camera.height, _ROWS):
            rows = np.arange(start, min(start + _ROWS, camera.height), dtype=np.float32)[:, None]
            rays = directions(camera, pose, columns, rows).reshape(-1, 3)
            hits = surfaces.trace(np.broadcast_to(eye_m, rays.shape).copy(), rays)
            there = hits.body >= 0
            surfaces.blocked(rays[there] * (0.999 * hits.length[there, None]) + eye_m, sun)


def _gl_picture(stage: Stage, camera: RenderCamera) -> Callable[[Pose, tuple[float, float]], Any]:
    """Return a function that draws pyrender's own picture of a stage, with shadows."""
    import pyrender  # noqa: PLC0415 - a process has one OpenGL platform, chosen by now

    from synth.render.gl import gl_eye  # noqa: PLC0415

    scene = pyrender.Scene(ambient_light=[0.3] * 3)
    for body in (*stage.rocks, *stage.ground):
        material = pyrender.MetallicRoughnessMaterial(
            baseColorFactor=[body.albedo] * 3 + [1.0], metallicFactor=0.0
        )
        primitive = pyrender.Primitive(
            positions=body.vertices_m.astype(np.float32),
            normals=body.normals.astype(np.float32),
            indices=body.faces.astype(np.uint32),
            material=material,
        )
        scene.add(pyrender.Mesh([primitive]))
    back = towards_sun(SunSpec())
    across = np.cross([0.0, 0.0, 1.0], back)
    across /= np.linalg.norm(across)
    sun_to_world = np.eye(4)
    sun_to_world[:3, :3] = np.column_stack([across, np.cross(back, across), back])
    scene.add(pyrender.DirectionalLight(color=np.ones(3), intensity=3.0), pose=sun_to_world)

    def draw(pose: Pose, limits_m: tuple[float, float]) -> None:
        eye, eye_to_world = gl_eye(camera, pose, limits_m)
        node = scene.add(eye, pose=eye_to_world)
        scene.main_camera_node = node
        renderer = pyrender.OffscreenRenderer(camera.width, camera.height)
        renderer.render(scene, flags=pyrender.constants.RenderFlags.SHADOWS_DIRECTIONAL)
        renderer.delete()
        scene.remove_node(node)

    return draw
