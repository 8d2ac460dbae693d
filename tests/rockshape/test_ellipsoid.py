import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

from rockshape.ellipsoid import Ellipsoid, fit_ellipsoid
from rockshape.measures.sphericity_3d import sphericity_3d
from tests import solids

CENTRE = np.array([0.05, -0.1, 2.0])


def seen_points(half_axes: np.ndarray, axes: np.ndarray) -> np.ndarray:
    points = solids.ellipsoid_range(
        solids.CAMERA, centre_m=CENTRE, half_axes_m=half_axes, axes=axes
    )
    return points[np.isfinite(points).all(axis=-1)]


@pytest.mark.parametrize(
    "half_axes",
    [(0.3, 0.3, 0.3), (0.35, 0.25, 0.15), (0.4, 0.4, 0.15), (0.4, 0.15, 0.15)],
    ids=["sphere", "triaxial", "oblate", "prolate"],
)
@pytest.mark.parametrize("turn", range(3))
def test_one_side_of_an_ellipsoid_gives_it_back(half_axes: tuple[float, ...], turn: int) -> None:
    truth = np.array(half_axes)
    axes = Rotation.from_rotvec([0.7 * turn, 0.4 * turn, -0.9 * turn]).as_matrix()
    fit = fit_ellipsoid(seen_points(truth, axes))
    assert fit is not None
    assert fit.converged
    assert not fit.bounded
    # exact range: the descent stops where the error is rounding
    assert fit.ellipsoid.half_axes_m == pytest.approx(truth, rel=1e-5)
    assert fit.ellipsoid.centre_m == pytest.approx(CENTRE, abs=1e-5)
    assert fit.mean_square_m2 < 1e-15
    c, b, a = sorted(half_axes)
    assert sphericity_3d(fit.ellipsoid.half_axes_m) == pytest.approx((c * c / a / b) ** (1 / 3))


def test_a_whole_box_has_the_axes_of_its_symmetry(rng: np.random.Generator) -> None:
    half = np.array([0.3, 0.2, 0.1])
    points = rng.uniform(-1, 1, (6000, 3))
    side = rng.integers(0, 3, 6000)
    points[np.arange(6000), side] = np.sign(points[np.arange(6000), side])
    fit = fit_ellipsoid(points * half + CENTRE)
    assert fit is not None
    a, b, c = fit.ellipsoid.half_axes_m
    assert a > b > c
    # the ellipsoid crosses the faces: its axes exceed the box's by less than to its corners
    assert np.all(fit.ellipsoid.half_axes_m > half)
    assert np.all(fit.ellipsoid.half_axes_m < np.sqrt(3) * half)
    # sampled at random: 6000 points leave the axes some hundredths of a radian
    assert np.abs(fit.ellipsoid.axes @ np.eye(3)).max(axis=1) == pytest.approx(1, abs=0.01)


def test_no_lower_minimum_is_found_by_powell(rng: np.random.Generator) -> None:
    half_axes, axes = np.array([0.35, 0.25, 0.2]), Rotation.from_rotvec([0.3, 0.5, 0.1]).as_matrix()
    points = seen_points(half_axes, axes)[::40]
    points = points + rng.normal(scale=0.005, size=points.shape)
    fit = fit_ellipsoid(points)
    assert fit is not None

    def mean_square(parameters: np.ndarray) -> float:
        ellipsoid = Ellipsoid(
            centre_m=parameters[:3],
            half_axes_m=np.exp(parameters[3:6]),
            axes=Rotation.from_rotvec(parameters[6:]).as_matrix(),
        )
        return float(np.mean(ellipsoid.radial_distance_m(points) ** 2))

    start = np.concatenate([CENTRE, np.log(half_axes), Rotation.from_matrix(axes).as_rotvec()])
    powell = minimize(mean_square, start, method="Powell", options={"maxiter": 200})
    # Powell stops at its own tolerance of 1e-4, above the minimum
    assert fit.mean_square_m2 <= powell.fun * (1 + 1e-9)
    assert fit.mean_square_m2 == pytest.approx(powell.fun, rel=1e-2)


def test_turning_and_moving_the_points_turns_and_moves_the_ellipsoid(
    rng: np.random.Generator,
) -> None:
    points = seen_points(np.array([0.35, 0.25, 0.2]), np.eye(3))[::20]
    points = points + rng.normal(scale=0.003, size=points.shape)
    turn = Rotation.from_rotvec([0.2, -1.0, 0.4]).as_matrix()
    first = fit_ellipsoid(points)
    second = fit_ellipsoid(3 * points @ turn.T)
    assert first is not None
    assert second is not None
    # the minimum is flat: both descents stop within 1e-10 of it in the sum of squares
    assert second.ellipsoid.half_axes_m == pytest.approx(3 * first.ellipsoid.half_axes_m, rel=1e-3)
    assert second.mean_square_m2 == pytest.approx(9 * first.mean_square_m2, rel=1e-6)


def test_a_flat_face_is_said_to_be_undetermined(rng: np.random.Generator) -> None:
    points = np.column_stack([rng.uniform(-0.2, 0.2, (500, 2)), np.full(500, 2.0)])
    points[:, 2] += rng.normal(scale=1e-4, size=500)
    fit = fit_ellipsoid(points)
    assert fit is not None
    assert fit.bounded


@pytest.mark.parametrize(
    "points",
    [np.empty((0, 3)), np.ones((100, 3)), np.linspace(0, 1, 100)[:, None] * [1.0, 2.0, 3.0]],
    ids=["none", "one place", "a line"],
)
def test_no_ellipsoid_where_none_is_determined(points: np.ndarray) -> None:
    assert fit_ellipsoid(points) is None


def test_radial_distance() -> None:
    ellipsoid = Ellipsoid(
        centre_m=np.zeros(3), half_axes_m=np.array([3.0, 2.0, 1.0]), axes=np.eye(3)
    )
    points = np.array([[4.0, 0, 0], [0, 1.0, 0], [0, 0, -3.0], [0, 0, 0]])
    assert ellipsoid.radial_distance_m(points) == pytest.approx([1.0, -1.0, 2.0, -1.0])
