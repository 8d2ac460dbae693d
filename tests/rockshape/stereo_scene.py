"""A textured sphere on a plane as two cameras see it, by intersecting each pixel's ray."""

from dataclasses import dataclass

import numpy as np

from rockshape.camera.lens import FramePose, Lens

SPHERE_M, RADIUS_M = np.array([0.02, 0.10, 1.5]), 0.15
NORMAL, OFFSET_M = np.array([0.0, np.cos(0.6), np.sin(0.6)]), 1.08
WAVES = 120
SHORTEST_M, LONGEST_M = 0.012, 0.12  # about 4 to 40 px


@dataclass(frozen=True, eq=False)
class Shot:
    """What one camera sees of the scene."""

    picture: np.ndarray  # (rows, cols) uint8
    points_m: np.ndarray  # (rows, cols, 3) in the frame of the left camera


def seen_by(lens: Lens, pose: FramePose | None = None) -> Shot:
    """Shot of the scene; pose brings points of the left camera to this one's frame."""
    rotation = np.eye(3) if pose is None else pose.rotation
    origin = np.zeros(3) if pose is None else -pose.rotation.T @ pose.translation_m
    rays = lens.rays() @ rotation
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    along = rays @ (SPHERE_M - origin)
    reach = along**2 - np.sum((SPHERE_M - origin) ** 2) + RADIUS_M**2
    sphere = np.where(reach > 0, along - np.sqrt(np.maximum(reach, 0)), np.inf)
    plane = (OFFSET_M - origin @ NORMAL) / (rays @ NORMAL)
    points = origin + rays * np.minimum(sphere, np.where(plane > 0, plane, np.inf))[..., None]
    return Shot(np.rint(255 * texture(points)).astype(np.uint8), points)


def texture(points: np.ndarray) -> np.ndarray:
    """Grey levels from 0 to 1 of points (..., 3): waves of all directions."""
    rng = np.random.default_rng(8)
    directions = rng.normal(size=(WAVES, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    lengths = np.exp(rng.uniform(np.log(SHORTEST_M), np.log(LONGEST_M), WAVES))
    phases = rng.uniform(0, 2 * np.pi, WAVES)
    level = np.zeros(points.shape[:-1])
    for direction, length, phase in zip(directions, lengths, phases, strict=True):
        level += np.sin(2 * np.pi / length * (points @ direction) + phase)
    return np.clip(0.5 + 0.2 * level / np.sqrt(WAVES / 2), 0, 1)
