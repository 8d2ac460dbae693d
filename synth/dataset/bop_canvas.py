"""Silhouettes beyond the frame, counted on the canvas of the BOP tools: three frames wide."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from synth.arrays import Floats
from synth.camera.camera import RenderCamera
from synth.camera.lens import distorted, undistorted
from synth.camera.pose import Pose
from synth.geometry.mesh import Mesh
from synth.light.rays import directions
from synth.scene.scene import SceneModel

Window = tuple[int, int, int, int]  # first column and row, and those after the last

_RAYS_AT_ONCE = 1 << 18
_NEAR_PX = 1e-3  # a ray that the lens does not put back on its pixel this near is none


@dataclass(frozen=True)
class Beyond:
    """Part of a silhouette beyond the frame; without a pixel there is no window."""

    count_px: int
    window: Window | None


class Canvas:
    """Canvas of nine frames, the camera's in the middle; a rock is set up when first asked for."""

    def __init__(self, scene: SceneModel) -> None:
        self._camera = scene.camera
        self._meshes = [placed.mesh for placed in scene.rocks]
        self._surfaces: dict[int, EmbreeScene] = {}

    def beyond(self, instance: int, pose: Pose, box_px: Floats) -> Beyond:
        """Part of one rock's silhouette beyond the frame, as if the rock were alone.

        `box_px`, (4,), holds its projection: left, top, right, bottom; NaN where it is not known.
        """
        if np.isnan(box_px).any() and self._behind(instance, pose):
            return Beyond(0, None)
        count_px, windows = 0, []
        for window in _strips(self._camera, box_px):
            hit = self._hit(instance, pose, window)
            rows, columns = np.flatnonzero(hit.any(axis=1)), np.flatnonzero(hit.any(axis=0))
            if len(rows):
                count_px += int(hit.sum())
                left, top = window[0] + int(columns[0]), window[1] + int(rows[0])
                right, bottom = window[0] + int(columns[-1]) + 1, window[1] + int(rows[-1]) + 1
                windows.append((left, top, right, bottom))
        return Beyond(count_px, united(windows))

    def _behind(self, instance: int, pose: Pose) -> bool:
        """Whether a rock lies wholly behind the camera, where no ray goes."""
        points_m = pose.camera_points_m(self._meshes[instance].vertices_m)
        return bool(points_m[:, 2].max() <= 0)

    def _hit(self, instance: int, pose: Pose, window: Window) -> NDArray[np.bool_]:
        """Mask of a window's pixels whose centres the rock covers, (rows, columns)."""
        if instance not in self._surfaces:
            self._surfaces[instance] = _surface(self._meshes[instance])
        rays, known = _rays(self._camera, pose, window)
        eye_m = np.broadcast_to(pose.position_m().astype(np.float32), rays.shape).copy()
        hit = self._surfaces[instance].run(eye_m, rays, query="OCCLUDED") >= 0
        return np.asarray(hit & known).reshape(window[3] - window[1], window[2] - window[0])


def united(windows: list[Window]) -> Window | None:
    """Smallest window that holds all, None without any."""
    if not windows:
        return None
    left, top = (min(window[side] for window in windows) for side in (0, 1))
    right, bottom = (max(window[side] for window in windows) for side in (2, 3))
    return left, top, right, bottom


def _strips(camera: RenderCamera, box_px: Floats) -> Iterator[Window]:
    """Windows beyond the frame that a box touches, each few enough pixels at once."""
    width, height = camera.width, camera.height
    low, high = np.array([-width, -height]), np.array([2 * width, 2 * height])
    if not np.isnan(box_px).any():
        low = np.clip(np.floor(box_px[:2]), low, high).astype(int)
        high = np.clip(np.ceil(box_px[2:]) + 1, low, high).astype(int)
    (left, top), (right, bottom) = low.tolist(), high.tolist()
    for window in (
        (left, top, right, min(bottom, 0)),
        (left, max(top, height), right, bottom),
        (left, max(top, 0), min(right, 0), min(bottom, height)),
        (max(left, width), max(top, 0), right, min(bottom, height)),
    ):
        if window[0] >= window[2]:
            continue
        step = max(1, _RAYS_AT_ONCE // (window[2] - window[0]))
        for start in range(window[1], window[3], step):
            yield window[0], start, window[2], min(start + step, window[3])


def _surface(mesh: Mesh) -> EmbreeScene:
    scene = EmbreeScene()
    faces = np.ascontiguousarray(mesh.faces, np.int32)
    TriangleMesh(scene, mesh.vertices_m.astype(np.float32), faces)
    return scene


def _rays(
    camera: RenderCamera, pose: Pose, window: Window
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """Rays through a window's pixel centres in the world, (n, 3), and which are known.

    A lens's model may not reach so far out: its inverse is checked.
    """
    left, top, right, bottom = window
    columns = np.arange(left, right, dtype=np.float32)[None, :]
    rows = np.arange(top, bottom, dtype=np.float32)[:, None]
    if camera.distortion is None:
        rays = directions(camera, pose, columns, rows).reshape(-1, 3)
        return rays, np.ones(len(rays), dtype=bool)
    wanted = np.stack(np.broadcast_arrays(columns - camera.cx, rows - camera.cy)).astype(np.float64)
    wanted = wanted.reshape(2, -1) / np.array([[camera.fx], [camera.fy]])
    with np.errstate(over="ignore", invalid="ignore"):
        across, down = undistorted(camera, wanted[0], wanted[1])
        strays = np.abs(np.stack(distorted(camera, across, down)) - wanted)
    known = (strays < _NEAR_PX / max(camera.fx, camera.fy)).all(axis=0)
    bent = np.column_stack([across, down, np.ones(len(across))])
    bent = np.where(known[:, None], bent, [0.0, 0.0, 1.0]) @ pose.world_to_camera
    return bent.astype(np.float32), known
