"""OpenGL through pyrender, on OSMesa or EGL.

Import this module only in a process whose PYOPENGL_PLATFORM is set: a process has one platform.
"""

import gc
from collections.abc import Sequence

import numpy as np
import pyrender
from numpy.typing import NDArray
from OpenGL import contextdata
from pyrender.constants import GLTF, RenderFlags

from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.light import Body, Stage

# pyrender collects garbage whenever a context is deleted; the imported modules, which stay, need
# not be searched each time.
gc.collect()
gc.freeze()

_OPENGL_FROM_OPENCV = np.diag([1.0, -1.0, -1.0])  # y up and z backward


class GLRenderer:
    """OpenGL renderer: a stage as a pyrender scene.

    Labels and depth come from the segmentation pass, which is never multisampled; the painter
    does the rest. Each pass makes its own off-screen context and deletes it: contexts that live on
    lose memory with every frame.
    """

    def __init__(self, stage: Stage, camera: RenderCamera) -> None:
        self._camera = camera
        self._scene = pyrender.Scene()
        self._rocks = [self._scene.add(_mesh(rock)) for rock in stage.rocks]
        self._ground = [self._scene.add(_mesh(body)) for body in stage.ground]
        self._things = [self._scene.add(_mesh(body)) for body in stage.things]

    def measure(
        self, pose: Pose, limits_m: tuple[float, float], rocks: Sequence[int] | None
    ) -> tuple[NDArray[np.uint16], NDArray[np.float64]]:
        """See `Renderer.measure`."""
        shown = range(len(self._rocks)) if rocks is None else rocks
        colours = {self._rocks[index]: _colour(index + 1) for index in shown}
        if rocks is None:
            colours.update({node: _colour(0) for node in self._ground})
            first = len(self._rocks) + 1
            colours.update({node: _colour(i) for i, node in enumerate(self._things, first)})
        colour, depth_m = self._render(pose, limits_m, colours)
        labels = colour[..., 0].astype(np.uint16) + 256 * colour[..., 1].astype(np.uint16)
        return labels, np.where(depth_m > 0.0, depth_m.astype(np.float64), np.nan)

    def _render(
        self,
        pose: Pose,
        limits_m: tuple[float, float],
        colours: dict[pyrender.Node, tuple[int, int, int]],
    ) -> tuple[NDArray[np.uint8], NDArray[np.float32]]:
        camera = self._camera
        eye, camera_to_world = gl_eye(camera, pose, limits_m)
        node = self._scene.add(eye, pose=camera_to_world)
        self._scene.main_camera_node = node
        kept = [len(storage) for storage in contextdata.STORAGES]
        renderer = pyrender.OffscreenRenderer(camera.width, camera.height)
        try:
            colour, depth_m = renderer.render(
                self._scene, flags=RenderFlags.SEG, seg_node_map=colours
            )
            return colour.copy(), depth_m.copy()
        finally:
            renderer.delete()
            self._scene.remove_node(node)
            _forget_since(kept)


def gl_eye(
    camera: RenderCamera, pose: Pose, limits_m: tuple[float, float]
) -> tuple[pyrender.IntrinsicsCamera, NDArray[np.float64]]:
    """Pyrender's camera between two depths, and its place in the world, (4, 4)."""
    # pyrender's pixel centres are at +0.5.
    eye = pyrender.IntrinsicsCamera(
        camera.fx,
        camera.fy,
        camera.cx + 0.5,
        camera.cy + 0.5,
        znear=limits_m[0],
        zfar=limits_m[1],
    )
    camera_to_world = np.eye(4)
    camera_to_world[:3, :3] = pose.world_to_camera.T @ _OPENGL_FROM_OPENCV
    camera_to_world[:3, 3] = pose.position_m()
    return eye, camera_to_world


def _forget_since(kept: Sequence[int]) -> None:
    """Drop what PyOpenGL holds for contexts that are gone: it keeps their arrays for ever."""
    for storage, count in zip(contextdata.STORAGES, kept, strict=True):
        for context in list(storage)[count:]:
            del storage[context]


def _mesh(body: Body) -> pyrender.Mesh:
    primitive = pyrender.Primitive(
        positions=body.vertices_m.astype(np.float32),
        indices=body.faces.astype(np.uint32),
        material=pyrender.MetallicRoughnessMaterial(alphaMode="OPAQUE"),
        mode=GLTF.TRIANGLES,
    )
    return pyrender.Mesh(primitives=[primitive])


def _colour(label: int) -> tuple[int, int, int]:
    return label % 256, label // 256, 0
