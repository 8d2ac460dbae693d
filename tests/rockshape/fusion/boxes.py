"""Boxes on level ground seen by pinhole cameras about them: exact range by closed form."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rockshape import Camera, CameraPose, Observation

CAMERA = Camera(fx=300.0, fy=300.0, cx=119.5, cy=89.5, width=240, height=180)


@dataclass(frozen=True)
class Block:
    """Upright box that stands on the ground z = 0, turned about z."""

    x: float
    y: float
    sides: tuple[float, float, float]  # m, along its own x, y and up
    turn: float = 0.0  # rad


BLOCKS = (
    Block(0.0, 0.0, (0.50, 0.36, 0.28), 0.4),
    Block(0.7, 0.5, (0.30, 0.26, 0.22), 1.1),
    Block(-0.6, 0.6, (0.34, 0.22, 0.18), -0.3),
)


def camera_at(azimuth_deg: float, *, distance: float = 2.6, height: float = 1.7) -> CameraPose:
    """Pose of a camera about the origin that looks at it; x right, y down, z forward."""
    azimuth = np.deg2rad(azimuth_deg)
    place = np.array([distance * np.cos(azimuth), distance * np.sin(azimuth), height])
    forward = (np.array([0.0, 0.0, 0.1]) - place) / np.linalg.norm([0.0, 0.0, 0.1] - place)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    return CameraPose(np.column_stack([right, np.cross(forward, right), forward]), place)


def seen(pose: CameraPose) -> tuple[Observation, NDArray[np.int32]]:
    """Observation of the blocks by a camera, and the labels of block i as i + 1."""
    rows, cols = np.mgrid[: CAMERA.height, : CAMERA.width]
    rays = np.stack(
        [(cols - CAMERA.cx) / CAMERA.fx, (rows - CAMERA.cy) / CAMERA.fy, np.ones(rows.shape)], -1
    )
    world = rays @ pose.camera_to_world.T
    with np.errstate(divide="ignore", invalid="ignore"):
        depth = np.where(world[..., 2] < 0, -pose.position_m[2] / world[..., 2], np.nan)
        labels = np.zeros(rows.shape, dtype=np.int32)
        for number, block in enumerate(BLOCKS, start=1):
            cos, sin = np.cos(block.turn), np.sin(block.turn)
            own = np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])
            middle = np.array([block.x, block.y, block.sides[2] / 2])
            start, along = own @ (pose.position_m - middle), world @ own.T
            half = np.array(block.sides) / 2
            ends = np.sort(np.stack([(-half - start) / along, (half - start) / along]), axis=0)
            enter, leave = ends[0].max(axis=-1), ends[1].min(axis=-1)
            hit = (enter < leave) & (enter > 0) & ~(enter > depth)
            depth, labels = np.where(hit, enter, depth), np.where(hit, number, labels)
    points = depth[..., None] * rays
    image = np.full(rows.shape, 0.5, dtype=np.float32)
    return Observation(image=image, points_m=points, camera=CAMERA), labels.astype(np.int32)
