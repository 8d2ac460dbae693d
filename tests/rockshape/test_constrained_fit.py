"""The ellipsoid held by range, silhouette and ground."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rockshape.camera.silhouette import grazing_rays
from rockshape.ellipsoid import HeldEllipsoid, Resting, fit_ellipsoid, fit_held_ellipsoid
from tests import solids

CENTRE = np.array([0.05, -0.1, 2.0])
UP = np.array([0.0, -0.8, -0.6])  # the camera looks down on the ground


def seen(half_axes: np.ndarray, axes: np.ndarray) -> tuple[np.ndarray, np.ndarray, Resting]:
    """Points, grazing rays, and the ground under an ellipsoid."""
    grid = solids.ellipsoid_range(solids.CAMERA, centre_m=CENTRE, half_axes_m=half_axes, axes=axes)
    mask = np.isfinite(grid).all(axis=-1)
    low = UP @ CENTRE - np.linalg.norm(half_axes * (axes @ UP))
    rays = grazing_rays(mask, (0, 0), solids.CAMERA, grid)
    return grid[mask], rays, Resting(normal=UP, offset_m=float(low))


def fitted(points: np.ndarray, rays: np.ndarray | None, ground: Resting | None) -> HeldEllipsoid:
    fit = fit_held_ellipsoid(points, silhouette=rays, ground=ground)
    assert fit is not None
    assert fit.converged
    assert not fit.bounded
    return fit


@pytest.mark.parametrize(
    "half_axes",
    [(0.3, 0.3, 0.3), (0.35, 0.25, 0.15), (0.4, 0.4, 0.15), (0.4, 0.15, 0.15)],
    ids=["sphere", "triaxial", "oblate", "prolate"],
)
@pytest.mark.parametrize("turned", range(3))
def test_an_ellipsoid_is_given_back(half_axes: tuple[float, ...], turned: int) -> None:
    truth = np.array(half_axes)
    axes = Rotation.from_rotvec([0.7 * turned, 0.4 * turned, -0.9 * turned]).as_matrix()
    fit = fitted(*seen(truth, axes))
    # the rays pass between pixels, half a pixel (2 mm) to either side of the outline at random
    assert fit.ellipsoid.half_axes_m == pytest.approx(truth, abs=2e-3)
    assert fit.ellipsoid.centre_m == pytest.approx(CENTRE, abs=2e-3)


def test_a_tenth_of_outliers_moves_it_little(rng: np.random.Generator) -> None:
    truth = np.array([0.35, 0.25, 0.2])
    points, rays, ground = seen(truth, np.eye(3))
    wild = rng.permutation(len(points))[: len(points) // 10]
    spoiled = points.copy()
    spoiled[wild] *= rng.uniform(0.5, 2.0, (len(wild), 1))
    held = fitted(spoiled, rays, ground).ellipsoid.half_axes_m
    assert held == pytest.approx(truth, rel=0.05)
    free = fit_ellipsoid(spoiled)
    # what the same points do to plain least squares
    assert free is None or np.abs(free.ellipsoid.half_axes_m / truth - 1).max() > 0.5


def test_silhouette_and_ground_hold_what_a_noisy_face_leaves_open(
    rng: np.random.Generator,
) -> None:
    truth = np.array([0.35, 0.25, 0.2])
    points, rays, ground = seen(truth, Rotation.from_rotvec([0.3, 0.5, 0.1]).as_matrix())
    noisy = points * (1 + rng.normal(scale=0.015, size=(len(points), 1)))
    held = fitted(noisy, rays, ground).ellipsoid.half_axes_m
    # 3 cm of noise on a rock of 20 cm
    assert held == pytest.approx(truth, rel=0.1)
    alone = fit_held_ellipsoid(noisy)
    assert alone is not None
    assert np.abs(alone.ellipsoid.half_axes_m / truth - 1).max() > 0.1


def test_rotation_scale_order_and_duplicates(rng: np.random.Generator) -> None:
    points, rays, ground = seen(np.array([0.35, 0.25, 0.2]), np.eye(3))
    points = points + rng.normal(scale=0.003, size=points.shape)
    base = fitted(points, rays, ground).ellipsoid
    spin = Rotation.from_rotvec([0.2, -1.0, 0.4]).as_matrix()
    turned = fitted(
        3 * points @ spin.T, rays @ spin.T, Resting(spin @ ground.normal, 3 * ground.offset_m)
    ).ellipsoid
    # the same points in the same order: equal but for where the descents stop
    assert turned.half_axes_m == pytest.approx(3 * base.half_axes_m, rel=1e-3)
    assert turned.centre_m == pytest.approx(3 * spin @ base.centre_m, abs=1e-3)
    order = rng.permutation(len(points))
    for other in (points[order], np.repeat(points, 2, axis=0)):
        again = fitted(other, rays, ground).ellipsoid
        # another 600 of the points are drawn, with 3 mm of noise each
        assert again.half_axes_m == pytest.approx(base.half_axes_m, rel=0.02)


@pytest.mark.parametrize(
    "points",
    [
        np.empty((0, 3)),
        np.ones((29, 3)),
        np.ones((100, 3)),
        np.linspace(0.5, 1, 100)[:, None] * [1.0, 2.0, 3.0],
    ],
    ids=["none", "few", "one place", "a line"],
)
def test_no_ellipsoid_where_none_is_determined(points: np.ndarray) -> None:
    assert fit_held_ellipsoid(points) is None


def test_a_flat_face_alone_is_said_to_be_undetermined(rng: np.random.Generator) -> None:
    points = np.column_stack([rng.uniform(-0.2, 0.2, (500, 2)), np.full(500, 2.0)])
    fit = fit_held_ellipsoid(points)
    assert fit is not None
    assert fit.bounded
