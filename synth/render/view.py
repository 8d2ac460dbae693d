"""One view: image, depth, labels and each rock's whole silhouette."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from synth.camera import Camera, Pose, project
from synth.light import Stage
from synth.render.interface import Renderer

Floats = NDArray[np.float64]

_SLACK = 0.05  # depth limits lie this far outside the scene's own, as a share


@dataclass(frozen=True, eq=False)
class View:
    """What the camera sees from one station."""

    image: NDArray[np.uint8]  # (rows, cols)
    depth_m: Floats  # (rows, cols), NaN where nothing is
    labels: NDArray[np.uint16]  # (rows, cols), 1 + the rock's index, 0 elsewhere
    silhouettes: tuple[NDArray[np.bool_], ...]  # (rows, cols) each, as if the rock were alone
    boxes_px: tuple[Floats, ...]  # left, top, right, bottom of each rock, beyond the frame too


def render_view(
    renderer: Renderer, stage: Stage, camera: Camera, pose: Pose, *, supersample: int
) -> View:
    """Return one view; the image is the mean of supersample² samples in each pixel."""
    limits_m = depth_limits_m(stage, camera, pose)
    labels, depth_m = renderer.measure(pose, limits_m, None)
    fine = renderer.paint(pose, limits_m, supersample)
    boxes_px = tuple(_box_px(rock.vertices_m, camera, pose) for rock in stage.rocks)
    silhouettes = [labels == index + 1 for index in range(len(stage.rocks))]
    for group in _hidden_groups(boxes_px):
        alone, _ = renderer.measure(pose, limits_m, group)
        for index in group:
            silhouettes[index] = alone == index + 1
    return View(
        image=block_mean(fine, supersample),
        depth_m=depth_m,
        labels=labels,
        silhouettes=tuple(silhouettes),
        boxes_px=boxes_px,
    )


def block_mean(fine: NDArray[np.uint8], factor: int) -> NDArray[np.uint8]:
    """Return the mean of each factor × factor block, halves rounded up."""
    rows, cols = fine.shape[0] // factor, fine.shape[1] // factor
    blocks = fine.reshape(rows, factor, cols, factor)
    total = blocks.sum(axis=(1, 3), dtype=np.uint32)
    return np.asarray((2 * total + factor**2) // (2 * factor**2), dtype=np.uint8)


def depth_limits_m(stage: Stage, camera: Camera, pose: Pose) -> tuple[float, float]:
    """Return the least and the greatest depth in view, with a little to spare.

    The ground's are at the frame's corners; where a corner shows sky the ground's far edge counts.
    The nearer the limits, the finer the steps of an OpenGL depth buffer.
    """
    rocks_m = [pose.camera_points_m(rock.vertices_m)[:, 2] for rock in stage.rocks]
    edge_m = float(np.abs(stage.ground.vertices_m).max())
    corners = np.array(
        [
            [(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1.0]
            for u in (-0.5, camera.width - 0.5)
            for v in (-0.5, camera.height - 0.5)
        ]
    )
    falls = -(corners @ pose.world_to_camera)[:, 2]
    height_m = float(pose.position_m()[2])
    ground_m = np.where(falls * edge_m > height_m, height_m / np.maximum(falls, 1e-9), edge_m)
    depths_m = np.concatenate([ground_m, *rocks_m])
    return float(depths_m.min()) * (1.0 - _SLACK), float(depths_m.max()) * (1.0 + _SLACK)


def _box_px(vertices_m: Floats, camera: Camera, pose: Pose) -> Floats:
    """Return left, top, right, bottom of a rock's projection, (4,)."""
    pixels = project(camera, pose.camera_points_m(vertices_m))
    return np.concatenate([pixels.min(axis=0), pixels.max(axis=0)])


def _hidden_groups(boxes_px: tuple[Floats, ...]) -> list[list[int]]:
    """Return the rocks whose boxes overlap another's, in groups without overlap inside.

    A rock whose box is free of all others is seen whole: its label is its silhouette already.
    """

    def overlap(first: int, second: int) -> bool:
        one, two = boxes_px[first], boxes_px[second]
        return bool((one[:2] <= two[2:] + 1.0).all() and (two[:2] <= one[2:] + 1.0).all())

    count = len(boxes_px)
    groups: list[list[int]] = []
    for index in range(count):
        if not any(overlap(index, other) for other in range(count) if other != index):
            continue
        for group in groups:
            if not any(overlap(index, member) for member in group):
                group.append(index)
                break
        else:
            groups.append([index])
    return groups
