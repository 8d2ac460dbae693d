"""The robust 3-D readings of a rock in view: laws and what they refuse."""

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from rockshape.ground import Ground, NoiseModel, Plane
from rockshape.measures import (
    Reason,
    angularity_3d,
    ellipsoid_error,
    roughness_3d,
    sphericity_3d,
)
from rockshape.rock.view import RockView
from tests import solids

MEASURES = (ellipsoid_error.ROBUST, sphericity_3d.ROBUST, angularity_3d.ROBUST, roughness_3d.ROBUST)
NO_EDGE = 1.0  # angularity of waves by chance; worn polyhedra have 1.1
UP = np.array([0.0, -0.8, -0.6])
CENTRE = np.array([0.05, -0.1, 2.0])
HALF_AXES = np.array([0.35, 0.28, 0.2])
AXES = Rotation.from_rotvec([0.4, -0.3, 0.7]).as_matrix()


def view(
    grid: NDArray[np.float64], *, scale: float = 1.0, noise: NoiseModel | None = None
) -> RockView:
    mask = np.isfinite(grid).all(axis=-1)
    low = UP @ CENTRE - np.linalg.norm(HALF_AXES * (AXES @ UP))
    plane = Plane(normal=UP, offset_m=float(scale * low), sigma_m=0.0, accepted=1.0)
    return RockView(
        mask=mask, grid_m=scale * grid, camera=solids.CAMERA, ground=Ground(plane, noise)
    )


def ellipsoid() -> NDArray[np.float64]:
    return solids.ellipsoid_range(solids.CAMERA, centre_m=CENTRE, half_axes_m=HALF_AXES, axes=AXES)


def rough(height: float) -> NDArray[np.float64]:
    """The ellipsoid's points moved along their rays by waves."""
    grid = ellipsoid()
    waves = np.cos(40 * grid[..., :1]) * np.cos(40 * grid[..., 1:2])
    return np.asarray(grid * (1 + height * waves))


def values(rock: RockView) -> list[float]:
    return [measure.read(rock).value for measure in MEASURES]


def test_an_ellipsoid_has_its_sphericity_and_nothing_else() -> None:
    error, sphericity, angularity, roughness = values(view(ellipsoid()))
    a, b, c = HALF_AXES
    # the outline's rays pass half a pixel off, 2 mm of 0.3 m
    assert sphericity == pytest.approx((c * c / (a * b)) ** (1 / 3), abs=0.01)
    assert error < 0.01
    assert angularity < 0.1
    assert roughness < 1e-4


def test_relief_raises_error_and_roughness_in_order() -> None:
    found = np.array([values(view(rough(height))) for height in (0.0, 0.003, 0.006, 0.012)])
    assert np.all(np.diff(found[:, 0]) > 0)
    assert np.all(np.diff(found[:, 3]) > 0)
    # and leaves the form but for the waves' height, 2 m x 0.012 at most, which c is the longer by
    c = HALF_AXES[2]
    assert np.ptp(found[:, 1]) < found[0, 1] * ((1 + 0.012 * CENTRE[2] / c) ** (2 / 3) - 1)


def test_size_does_not_count() -> None:
    once, thrice = values(view(rough(0.006))), values(view(rough(0.006), scale=3.0))
    assert thrice == pytest.approx(once, rel=1e-6)


def test_holes_and_a_tenth_of_outliers(rng: np.random.Generator) -> None:
    grid = rough(0.006)
    once = values(view(grid))
    mask = np.isfinite(grid).all(axis=-1)
    holes = grid.copy()
    holes[rng.random(mask.shape) < 0.3] = np.nan
    holed = view(holes)
    pierced = RockView(mask=mask, grid_m=holes, camera=solids.CAMERA, ground=holed.ground)
    # other points are drawn
    found = np.delete(values(pierced), 2)
    assert found == pytest.approx(np.delete(once, 2), rel=0.05)
    assert values(pierced)[2] < NO_EDGE
    wild = mask & (rng.random(mask.shape) < 0.1)
    spoiled = grid.copy()
    spoiled[wild] *= rng.uniform(0.7, 1.4, (int(wild.sum()), 1))
    _, sphericity, angularity, roughness = values(view(spoiled))
    assert sphericity == pytest.approx(once[1], abs=0.04)
    assert angularity < NO_EDGE
    assert roughness == pytest.approx(once[3], rel=0.3)


def test_what_noise_hides_is_not_told() -> None:
    rock = view(rough(0.006), noise=NoiseModel(0.02, 7, 0.0, 1 / solids.CAMERA.fx))  # 8 cm at 2 m
    error, sphericity, angularity, roughness = (measure.read(rock) for measure in MEASURES)
    assert error.reason == angularity.reason == roughness.reason == Reason.NOT_RESOLVABLE
    assert np.isfinite(sphericity.value)


def flat() -> NDArray[np.float64]:
    grid = np.full((*solids.CAMERA.shape, 3), np.nan)
    grid[60:160, 80:220] = solids.plane_range(
        solids.CAMERA, normal=np.array([0.1, -0.2, -0.97]), offset_m=-2.0
    )[60:160, 80:220]
    return grid


def few(pixels: tuple[slice, slice]) -> NDArray[np.float64]:
    grid = ellipsoid()
    keep = np.zeros(grid.shape[:2], dtype=bool)
    keep[pixels] = True
    return np.asarray(np.where(keep[..., None], grid, np.nan))


@pytest.mark.parametrize(
    "grid",
    [
        np.full((*solids.CAMERA.shape, 3), np.nan),
        few(np.s_[100:101, 160:161]),
        few(np.s_[100:101, 120:200]),
        few(np.s_[100:102, 160:162]),
        np.where(np.isfinite(ellipsoid()), [0.1, 0.1, 2.0], np.nan),
    ],
    ids=["no range", "one pixel", "a line", "four pixels", "one place"],
)
def test_degenerate_rocks_are_nan(grid: NDArray[np.float64]) -> None:
    mask = np.isfinite(grid).all(axis=-1)
    if not mask.any():
        mask[100:140, 140:180] = True
    rock = RockView(mask=mask, grid_m=grid, camera=solids.CAMERA)
    assert np.isnan(values(rock)).all()
    assert np.isnan(values(RockView(mask=mask))).all()


def test_coplanar_points_give_no_angularity_beyond_their_edges() -> None:
    # a face alone: an ellipsoid is held by the outline, or none; never a crash
    rock = view(flat())
    assert all(np.isnan(value) or 0 <= value < 5 for value in values(rock))


def test_what_camera_and_ground_are_missing_is_done_without() -> None:
    grid = ellipsoid()
    rock = RockView(mask=np.isfinite(grid).all(axis=-1), grid_m=grid)
    a, b, c = HALF_AXES
    assert values(rock)[1] == pytest.approx((c * c / (a * b)) ** (1 / 3), abs=0.01)
