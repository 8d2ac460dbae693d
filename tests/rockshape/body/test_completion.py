"""Bodies of known form completed from one side."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rockshape.body import completed
from rockshape.ellipsoid import Ellipsoid
from rockshape.ground import Plane

SIDES = np.array([0.3, 0.2, 0.12])
UP = np.array([0.0, -0.8, -0.6])


def never(points_m: np.ndarray) -> np.ndarray:
    return np.zeros(len(points_m), dtype=bool)


def surface(body: Ellipsoid, count: int = 20_000) -> np.ndarray:
    sphere = np.random.default_rng(1).standard_normal((count, 3))
    return body.from_sphere(sphere / np.linalg.norm(sphere, axis=1, keepdims=True))


def facing(body: Ellipsoid, points_m: np.ndarray) -> np.ndarray:
    """Those that a camera at the origin sees."""
    normals = body.to_sphere(points_m) / body.half_axes_m @ body.axes
    return points_m[(normals * points_m).sum(axis=1) < 0]


@pytest.mark.parametrize("turn", [[0.4, -0.3, 0.7], [1.2, 0.5, 0.1], [0.0, 0.0, 0.0]])
def test_a_turned_ellipsoid_is_completed_to_itself(turn: list[float]) -> None:
    body = Ellipsoid(np.array([0.1, 0.2, 2.0]), SIDES, Rotation.from_rotvec(turn).as_matrix())
    plane = Plane(UP, float(-body.support_m(-UP)), 0.0, 1.0)
    found = completed(facing(body, surface(body)), body, plane=plane, seen_past=never)
    ways = np.random.default_rng(2).standard_normal((50, 3))
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    assert (found @ ways.T).max(axis=0) == pytest.approx(body.support_m(ways), abs=0.03 * SIDES[1])


def test_a_block_reaches_down_to_the_ground_and_no_farther() -> None:
    axes = np.array([[1.0, 0.0, 0.0], np.cross(UP, [1.0, 0.0, 0.0]), UP])
    block = np.random.default_rng(3).uniform(-1, 1, (6000, 3))
    block[np.arange(6000), np.arange(6000) % 3] = np.sign(block[:, 0])
    centre = np.array([0.0, 0.1, 2.0])
    points = centre + (block * SIDES) @ axes
    plane = Plane(UP, float(centre @ UP - SIDES[2]), 0.0, 1.0)
    seen = points[plane.height_m(points) > 0.05]
    body = Ellipsoid(centre, 1.3 * SIDES, axes)
    found = completed(seen, body, plane=plane, seen_past=never)
    assert np.ptp(found @ axes.T, axis=0) / 2 == pytest.approx(SIDES, rel=0.05)
    assert plane.height_m(found).min() > -1e-9


def test_what_the_camera_saw_past_is_no_part() -> None:
    body = Ellipsoid(np.array([0.0, 0.0, 2.0]), SIDES, np.eye(3))
    seen = facing(body, surface(body))
    found = completed(seen, body, plane=None, seen_past=lambda points: points[:, 2] > 2.05)
    assert found[:, 2].max() <= 2.05
    assert completed(seen, body, plane=None, seen_past=never)[:, 2].max() > 2.1
