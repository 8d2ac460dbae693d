"""The derivatives that the descents run on, against differences of what they derive."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from rockshape.ellipsoid.parameters import State, turn
from rockshape.ellipsoid.radial_cost import CHUNK, Radial
from rockshape.ellipsoid.residuals import (
    Linearised,
    lowest_point,
    points_to_surface,
    rays_to_silhouette,
)

FREE = (-9.0, 9.0)
STATE = State(
    centre=np.array([0.1, -0.2, 0.15]),
    log_axes=np.array([0.3, -0.1, -0.4]),
    rotation=Rotation.from_rotvec([0.4, -1.1, 0.6]).as_matrix(),
)


@pytest.mark.parametrize("weighted", [False, True])
@pytest.mark.parametrize("count", [60, CHUNK + 7])
def test_gradient_and_hessian_of_the_radial_cost(
    weighted: bool, count: int, rng: np.random.Generator
) -> None:
    weights = rng.uniform(0.2, 1, count) if weighted else None
    points = rng.normal(size=(3, count))
    # away from the centre, where the distance has a corner
    points *= (0.7 + rng.random(count)) / np.linalg.norm(points, axis=0)
    problem = Radial(points, weights)

    def cost(step: NDArray[np.float64]) -> float:
        return problem.cost(STATE.moved(step, FREE))

    gradient, hessian = problem.derivatives(STATE, whole=True)
    size = np.abs(hessian).max()
    nudges = 1e-5 * np.eye(9)
    slope = [(cost(nudge) - cost(-nudge)) / 2e-5 for nudge in nudges]
    # differences of second order: 1e-10 of the third derivative, and rounding over the step
    assert gradient == pytest.approx(slope, abs=1e-8 * size)
    nudges = 1e-3 * np.eye(9)
    curve = [
        [(cost(a + b) - cost(a - b) - cost(b - a) + cost(-a - b)) / 4e-6 for b in nudges]
        for a in nudges
    ]
    assert hessian == pytest.approx(np.array(curve), abs=1e-5 * size)


def test_gauss_newton_is_the_square_of_the_jacobian(rng: np.random.Generator) -> None:
    points = rng.normal(size=(3, 50))
    jacobian = points_to_surface(points, STATE).jacobian
    _, system = Radial(points).derivatives(STATE, whole=False)
    assert system == pytest.approx(jacobian @ jacobian.T, rel=1e-9)


@pytest.mark.parametrize(
    "linearise",
    [
        lambda state, vectors: points_to_surface(vectors, state),
        lambda state, vectors: rays_to_silhouette(vectors, np.array([0.3, -0.2, -3.0]), state),
        lambda state, vectors: lowest_point(vectors[:, 0] / np.linalg.norm(vectors[:, 0]), state),
    ],
    ids=["points", "rays", "lowest point"],
)
def test_jacobians(
    linearise: Callable[[State, NDArray[np.float64]], Linearised], rng: np.random.Generator
) -> None:
    vectors = rng.normal(size=(3, 40))
    found = linearise(STATE, vectors)
    for nudge, slope in zip(1e-6 * np.eye(9), found.jacobian, strict=True):
        up, down = (linearise(STATE.moved(step, FREE), vectors) for step in (nudge, -nudge))
        # differences over 1e-6: rounding of 1e-16 and truncation both leave about 1e-9
        assert slope == pytest.approx((up.residuals - down.residuals) / 2e-6, abs=1e-7)


@pytest.mark.parametrize("vector", [(0, 0, 0), (1e-6, 0, 2e-6), (0.3, -1.2, 0.5), (0, 3.1, 0)])
def test_turn_is_a_rotation_by_the_vector(vector: tuple[float, ...]) -> None:
    expected = Rotation.from_rotvec(vector).as_matrix()
    assert turn(np.array(vector, dtype=float)) == pytest.approx(expected, abs=1e-14)


def test_a_tangent_ray_has_distance_zero(rng: np.random.Generator) -> None:
    ellipsoid = STATE.ellipsoid()
    eye = np.array([0.5, 0.2, -4.0])
    # on the unit sphere a point x is on the rim seen from e where x . e = 1
    view = ellipsoid.to_sphere(eye)
    across = np.linalg.svd(view[None])[2][1:]
    angle = rng.uniform(0, 2 * np.pi, 30)
    height = 1 / (view @ view)
    rim = height * view + np.sqrt(1 - height) * (
        np.cos(angle)[:, None] * across[0] + np.sin(angle)[:, None] * across[1]
    )
    rays = (ellipsoid.from_sphere(rim) - eye).T
    assert rays_to_silhouette(rays, eye, STATE).residuals == pytest.approx(0, abs=1e-12)
    # a sideways move of the eye by the support of the ellipsoid's silhouette: outside is positive
    wider = rays + 0.05 * (ellipsoid.from_sphere(rim) - ellipsoid.centre_m).T
    assert np.all(rays_to_silhouette(wider, eye, STATE).residuals > 0)
