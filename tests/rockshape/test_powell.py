import numpy as np
import pytest

from rockshape.ellipsoid import fit_ellipsoid
from rockshape.ellipsoid.distance import hausdorff_m
from rockshape.ellipsoid.powell import fit_by_powell, paper_rotation
from tests import solids


def cloud(rng: np.random.Generator, count: int = 300) -> np.ndarray:
    points = solids.ellipsoid_range(
        solids.CAMERA,
        centre_m=np.array([0.05, -0.1, 2.0]),
        half_axes_m=np.array([0.35, 0.25, 0.2]),
        axes=paper_rotation(np.array([0.4, -0.3, 0.7])),
    )
    points = points[np.isfinite(points).all(axis=-1)]
    chosen = points[rng.permutation(len(points))[:count]]
    return np.asarray(chosen + rng.normal(scale=0.004, size=chosen.shape))


def test_powell_and_the_descent_find_the_same_minimum(rng: np.random.Generator) -> None:
    points = cloud(rng)
    ours, powell = fit_ellipsoid(points), fit_by_powell(points, tolerance=1e-9)
    assert ours is not None
    assert powell is not None
    assert ours.converged
    assert powell.converged
    assert powell.distance == pytest.approx(ours.mean_square_m2, rel=1e-6)
    # the minimum is flat: 1e-6 of the sum of squares is a thousandth of an axis
    assert powell.ellipsoid.half_axes_m == pytest.approx(ours.ellipsoid.half_axes_m, rel=1e-2)
    own = powell.ellipsoid.radial_distance_m(points)
    assert powell.distance == pytest.approx(float(np.mean(own**2)), rel=1e-9)


def test_powell_lowers_the_hausdorff_distance(rng: np.random.Generator) -> None:
    points = cloud(rng, 60)
    ours = fit_ellipsoid(points)
    assert ours is not None
    found = fit_by_powell(points, distance="hausdorff", tolerance=1e-2, near=ours)
    assert found is not None
    assert found.distance < hausdorff_m(ours.ellipsoid, points, samples=512)
    assert found.distance == pytest.approx(hausdorff_m(found.ellipsoid, points, samples=512))


def test_the_papers_rotations_make_a_rotation() -> None:
    rotation = paper_rotation(np.array([0.3, -1.0, 2.0]))
    assert rotation @ rotation.T == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(rotation) == pytest.approx(1)


@pytest.mark.parametrize(
    "points",
    [np.ones((10, 3)), np.ones((100, 3)), np.linspace(0, 1, 100)[:, None] * [1.0, 2.0, 3.0]],
    ids=["few", "one place", "a line"],
)
def test_no_ellipsoid_where_none_is_determined(points: np.ndarray) -> None:
    assert fit_by_powell(points) is None
