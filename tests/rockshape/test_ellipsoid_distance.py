import numpy as np
import pytest
from scipy.spatial.distance import cdist
from scipy.spatial.transform import Rotation

from rockshape.ellipsoid import Ellipsoid, hausdorff_m, orthogonal_distance_m
from rockshape.ellipsoid.distance import nearest_on, surface_points_m

BODY = Ellipsoid(
    centre_m=np.array([0.3, -0.1, 2.0]),
    half_axes_m=np.array([0.5, 0.3, 0.1]),
    axes=Rotation.from_rotvec([0.4, -1.1, 0.6]).as_matrix(),
)


def test_orthogonal_distance_against_brute_force(rng: np.random.Generator) -> None:
    points = BODY.centre_m + rng.normal(scale=0.3, size=(200, 3))
    dense = surface_points_m(BODY, 200_000)
    brute = cdist(points, dense).min(axis=1)
    # the dense points are about 0.003 apart, and the nearest is off by at most h²/(2 d)
    assert np.abs(orthogonal_distance_m(BODY, points)) == pytest.approx(brute, abs=2e-3)
    assert np.all(np.abs(orthogonal_distance_m(BODY, points)) <= brute + 1e-12)


def test_the_nearest_point_is_on_the_surface_and_the_offset_along_its_normal(
    rng: np.random.Generator,
) -> None:
    points = BODY.centre_m + rng.normal(scale=0.4, size=(500, 3))
    nearest = nearest_on(BODY, points)
    sphere = BODY.to_sphere(nearest)
    assert np.linalg.norm(sphere, axis=1) == pytest.approx(1, abs=1e-12)
    normal = sphere / BODY.half_axes_m @ BODY.axes
    offset = points - nearest
    # parallel up to rounding, which points inside near the evolute magnify
    assert np.abs(np.cross(normal, offset)).max() < 1e-7


def test_distance_on_axes_and_at_the_centre() -> None:
    body = Ellipsoid(centre_m=np.zeros(3), half_axes_m=np.array([3.0, 2, 1]), axes=np.eye(3))
    points = np.array([[4.0, 0, 0], [0, 5, 0], [0, 0, -3], [0, 0, 0], [0, 0, 0.5]])
    # rounding picks the side of a plane of symmetry: the point moves by 1e-14
    assert orthogonal_distance_m(body, points) == pytest.approx([1, 3, 2, -1, -0.5], abs=1e-9)


def test_radial_distance_is_never_shorter(rng: np.random.Generator) -> None:
    points = BODY.centre_m + rng.normal(scale=0.4, size=(500, 3))
    orthogonal, radial = orthogonal_distance_m(BODY, points), BODY.radial_distance_m(points)
    assert np.all(np.abs(radial) >= np.abs(orthogonal) - 1e-12)
    assert np.array_equal(np.sign(radial), np.sign(orthogonal))


def test_on_a_sphere_both_distances_are_one(rng: np.random.Generator) -> None:
    ball = Ellipsoid(centre_m=np.ones(3), half_axes_m=np.full(3, 0.5), axes=np.eye(3))
    points = rng.normal(size=(100, 3))
    assert orthogonal_distance_m(ball, points) == pytest.approx(ball.radial_distance_m(points))


def test_hausdorff_against_brute_force(rng: np.random.Generator) -> None:
    points = surface_points_m(BODY, 300) + rng.normal(scale=0.02, size=(300, 3))
    dense = surface_points_m(BODY, 20_000)
    table = cdist(points, dense)
    brute = max(table.min(axis=1).max(), table.min(axis=0).max())
    # spacing of the samples: 0.5 sqrt(4 pi / 20000) = 0.013
    assert hausdorff_m(BODY, points, samples=20_000) == pytest.approx(brute, abs=0.013)


def test_hausdorff_of_one_side_is_about_the_far_side() -> None:
    ball = Ellipsoid(centre_m=np.zeros(3), half_axes_m=np.ones(3), axes=np.eye(3))
    points = surface_points_m(ball, 4000)
    near = points[points[:, 2] < 0]
    # the far pole is a quarter circle from the rim: a chord of sqrt 2
    assert hausdorff_m(ball, near) == pytest.approx(np.sqrt(2), abs=0.05)
    assert np.isnan(hausdorff_m(ball, np.empty((0, 3))))


def test_support_is_the_farthest_point() -> None:
    normals = np.array([[0, 0, 1.0], [0.6, 0, -0.8], [0, -1, 0]])
    reach = (surface_points_m(BODY, 100_000) @ normals.T).max(axis=0)
    assert BODY.support_m(normals) == pytest.approx(reach, abs=1e-4)
