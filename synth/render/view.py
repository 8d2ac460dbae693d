"""Rendering of one view: image, depth, labels and each rock's complete silhouette."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.arrays import Floats
from synth.camera.camera import RenderCamera
from synth.camera.pose import Pose
from synth.camera.projection import border_rays, project
from synth.light import Stage
from synth.light.colour import luminance
from synth.render.interface import Renderer
from synth.render.normals import normal_map
from synth.render.silhouettes import Cutout, Silhouettes
from synth.things.record import CLASSES

_NEAREST_M = 0.1  # what is nearer, or behind the camera, is not seen
_SLACK = 0.05  # depth limits lie this far outside the scene's own, as a share


@dataclass(frozen=True, eq=False)
class Sight:
    """Rocks that the camera sees from one station: all of a view that the tables need."""

    labels: NDArray[np.uint16]  # (rows, cols), 1 + the rock's index, 0 elsewhere
    silhouettes: Silhouettes  # (rows, cols) each, as if the rock were alone
    boxes_px: tuple[Floats, ...]  # left, top, right, bottom of each rock, beyond the frame too

    def visible(self, index: int) -> Cutout:
        """Visible part of a rock's silhouette."""
        return self.silhouettes.seen(index, self.labels)


@dataclass(frozen=True, eq=False)
class RenderedView(Sight):
    """Rendered view from one station."""

    image: NDArray[np.uint8]  # (rows, cols)
    light: NDArray[np.float32]  # (rows, cols), before it is rounded and clipped, 1 for white
    not_rock: NDArray[np.uint8]  # (rows, cols), class of the thing seen, 0 elsewhere
    colour: NDArray[np.float32] | None  # (rows, cols, 3), red, green and blue likewise
    normals: NDArray[np.float32] | None  # (rows, cols, 3), in the camera's frame, NaN likewise
    depth_m: Floats  # (rows, cols), NaN where nothing is

    def sight(self) -> Sight:
        """View without its pictures, which take six times as much memory."""
        return Sight(self.labels, self.silhouettes, self.boxes_px)


def render_view(
    renderer: Renderer,
    stage: Stage,
    camera: RenderCamera,
    pose: Pose,
    *,
    supersample: int,
    normals: bool = False,
) -> RenderedView:
    """One view; at edges the image is the mean of supersample² samples in each pixel.

    Normals are made where they are asked for, colour where the stage has it.
    """
    limits_m = depth_limits_m(stage, camera, pose)
    seen, depth_m = renderer.measure(pose, limits_m, None)
    painted = stage.painter.paint(camera, pose, seen, depth_m, supersample=supersample)
    light = luminance(painted)
    labels = np.where(seen > len(stage.rocks), 0, seen).astype(np.uint16)
    classes = [0] * (len(stage.rocks) + 1) + [CLASSES[kind] for kind in stage.thing_kinds]
    boxes_px = tuple(_box_px(rock.vertices_m, camera, pose) for rock in stage.rocks)
    silhouettes = Silhouettes(labels, boxes_px)
    crowded = bool(stage.things) or stage.hiding
    for group in _hidden_groups(boxes_px, camera, crowded=crowded):
        alone, _ = renderer.measure(pose, limits_m, group)
        silhouettes.replace(group, alone)
    return RenderedView(
        image=np.rint(255.0 * np.clip(light, 0.0, 1.0)).astype(np.uint8),
        light=light,
        not_rock=np.array(classes, dtype=np.uint8)[seen],
        colour=painted if stage.painter.channels > 1 else None,
        normals=normal_map(stage, camera, pose) if normals else None,
        depth_m=depth_m,
        labels=labels,
        silhouettes=silhouettes,
        boxes_px=boxes_px,
    )


def render_light(
    renderer: Renderer, stage: Stage, camera: RenderCamera, pose: Pose, *, supersample: int
) -> NDArray[np.float32]:
    """Luminance of one view alone, (rows, cols), 1 for white."""
    labels, depth_m = renderer.measure(pose, depth_limits_m(stage, camera, pose), None)
    painted = stage.painter.paint(camera, pose, labels, depth_m, supersample=supersample)
    return luminance(painted)


def depth_limits_m(stage: Stage, camera: RenderCamera, pose: Pose) -> tuple[float, float]:
    """Least and the greatest depth in view, with a little to spare.

    The ground's are its plane's along the frame's border, as much nearer as ripples and pebbles
    rise above it and as much farther as hollows lie below; where the border shows sky the ground's
    far edge counts. The nearer the limits, the finer the steps of an OpenGL depth buffer.
    """
    bodies = [*stage.rocks, *stage.things]
    rocks_m = [pose.camera_points_m(body.vertices_m)[:, 2] for body in bodies]
    surface_m = stage.ground[0].vertices_m
    edge_m = float(np.abs(surface_m).max())
    rays = np.concatenate(border_rays(camera))
    border = np.column_stack([rays, np.ones(len(rays))]) @ pose.world_to_camera
    up = stage.plane_normal
    falls, height_m = -(border @ up), float(pose.position_m() @ up)
    lowest_m = height_m + stage.drop_m  # above the lowest ground
    ground_m = np.where(falls * edge_m > lowest_m, lowest_m / np.maximum(falls, 1e-9), edge_m)
    nearest_m = (height_m - stage.rise_m) / lowest_m * ground_m.min()
    depths_m = np.concatenate([ground_m, [max(nearest_m, _NEAREST_M)], *rocks_m])
    ahead_m = depths_m[depths_m > _NEAREST_M]
    return float(ahead_m.min()) * (1.0 - _SLACK), float(ahead_m.max()) * (1.0 + _SLACK)


def _box_px(vertices_m: Floats, camera: RenderCamera, pose: Pose) -> Floats:
    """Left, top, right, bottom of a rock's projection, (4,); NaN if not all is ahead."""
    points_m = pose.camera_points_m(vertices_m)
    if points_m[:, 2].min() <= _NEAREST_M:
        return np.full(4, np.nan)
    pixels = project(camera, points_m)
    return np.concatenate([pixels.min(axis=0), pixels.max(axis=0)])


def _hidden_groups(
    boxes_px: tuple[Floats, ...], camera: RenderCamera, *, crowded: bool
) -> list[list[int]]:
    """Rocks whose boxes overlap another's, in groups without overlap inside; all if crowded.

    A rock whose box is free of all others is seen whole: its label is its silhouette already; one
    whose box is outside the frame is not seen at all. On hiding ground any rock may be covered.
    """
    if not boxes_px:
        return []
    boxes = np.stack(boxes_px)
    shown = (boxes[:, 2:] >= -0.5).all(axis=1) & (boxes[:, 0] <= camera.width - 0.5)
    shown &= boxes[:, 1] <= camera.height - 0.5
    overlap = (boxes[:, None, :2] <= boxes[None, :, 2:] + 1.0).all(axis=2)
    overlap &= overlap.T & shown & shown[:, None] & ~np.eye(len(boxes), dtype=bool)
    groups: list[list[int]] = []
    for index in np.flatnonzero(shown if crowded else overlap.any(axis=1)):
        for group in groups:
            if not overlap[index, group].any():
                group.append(int(index))
                break
        else:
            groups.append([int(index)])
    return groups
