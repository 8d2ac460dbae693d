"""What stands out of a rock's ellipsoid."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rockshape.camera.camera import Camera
from rockshape.ellipsoid import Ellipsoid
from rockshape.ground import NoiseModel
from rockshape.measures.angularity_3d import angularity_3d
from rockshape.measures.roughness_3d import roughness_3d
from rockshape.surface import Relief, measure_relief
from tests import solids

BODY = Ellipsoid(
    centre_m=np.array([0.05, -0.1, 2.0]),
    half_axes_m=np.array([0.35, 0.3, 0.25]),
    axes=Rotation.from_rotvec([0.4, -0.3, 0.7]).as_matrix(),
)


def seen(body: Ellipsoid, camera: Camera = solids.CAMERA) -> np.ndarray:
    """Points (rows, cols, 3) of an ellipsoid."""
    return solids.ellipsoid_range(
        camera, centre_m=body.centre_m, half_axes_m=body.half_axes_m, axes=body.axes
    )


def known(grid: np.ndarray) -> np.ndarray:
    return np.asarray(grid[np.isfinite(grid).all(axis=-1)])


def dented(points: np.ndarray, height: float, waves: float) -> np.ndarray:
    """Points moved from the centre by a wave over the unit sphere, height in radii."""
    sphere = BODY.to_sphere(points)
    return BODY.from_sphere(sphere * (1 + height * np.cos(waves * sphere[:, :1])))


def relief(points: np.ndarray, body: Ellipsoid = BODY) -> Relief:
    found = measure_relief(body, points)
    assert found is not None
    return found


def bend(points: np.ndarray, body: Ellipsoid = BODY) -> float:
    return angularity_3d(relief(points, body))


def cut(points: np.ndarray, rounding: float) -> np.ndarray:
    """The ellipsoid's sphere, cut to a cube of rounded edges about it, by steps to its surface."""
    sphere = BODY.to_sphere(points)
    direction = sphere / np.linalg.norm(sphere, axis=1)[:, None]
    half, reach = 0.85 * (1 - rounding), np.ones(len(points))
    for _ in range(60):
        outside = np.maximum(np.abs(reach[:, None] * direction) - half, 0)
        reach -= np.linalg.norm(outside, axis=1) - 0.85 * rounding
    return BODY.from_sphere(reach[:, None] * direction)


def strip(body: Ellipsoid, left: float, right: float) -> np.ndarray:
    """Points of the side towards the camera, between two places along the longest axis in radii."""
    towards = body.to_sphere(np.zeros(3))
    drawn = np.random.default_rng(3).normal(size=(400_000, 3))
    drawn /= np.linalg.norm(drawn, axis=1)[:, None]
    kept = (drawn[:, 0] > left) & (drawn[:, 0] < right) & (drawn @ towards > 0)
    return body.from_sphere(drawn[kept][:3000])


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("width", [0.05, 0.08, 0.1, 0.12, 0.2, 0.5])
def test_a_strip_of_an_ellipsoid_has_none(width) -> None:
    found = relief(strip(BODY, 0.0, width))
    assert found.edge_bend_cubed == pytest.approx(0.0, abs=1e-9)
    assert found.rough == pytest.approx(0.0, abs=1e-9)


def test_a_strip_that_holds_no_middle_of_a_cell_is_not_measured() -> None:
    upright = replace(BODY, centre_m=np.array([0.0, 0.0, 2.0]), axes=np.eye(3))
    assert measure_relief(upright, strip(upright, 0.0, 0.02)) is None


def test_an_ellipsoid_has_none() -> None:
    # the range is exact
    found = relief(known(seen(BODY)))
    assert abs(found.edge_bend_cubed) < 1e-9
    assert found.rough < 1e-9


def test_relief_is_rough_and_no_edge() -> None:
    points = known(seen(BODY))
    found = [relief(dented(points, height, 20.0)) for height in (0.002, 0.01)]
    assert found[1].rough == pytest.approx(5 * found[0].rough, rel=0.05)
    # of a wave's heights the median is its height over sqrt(2), and 1.483 of that is told; waves
    # of a third of the radius keep 0.8 of it, and grow longer on the chart towards the sides
    whole = 0.01 * 1.483 / np.sqrt(2)
    assert 0.5 * whole < found[1].rough < 0.85 * whole
    bends = 0.01 * 20**2 / 2  # of the wave's crests
    assert abs(np.cbrt(found[1].edge_bend_cubed)) < 0.4 * bends


def test_relief_hardly_moves_the_edges_that_it_lies_on(rng: np.random.Generator) -> None:
    points = known(seen(BODY))
    sharp = cut(points, 0.2)
    sphere = BODY.to_sphere(sharp)
    along = rng.standard_normal((3, 40))
    along *= 22 / np.linalg.norm(along, axis=0)
    waves = np.cos(sphere @ along + rng.uniform(0, 2 * np.pi, 40)).sum(axis=1)
    rough = BODY.from_sphere(sphere * (1 + 0.004 * (waves / waves.std())[:, None]))
    assert bend(rough) == pytest.approx(bend(sharp), rel=0.1)


def test_sharp_edges_bend_more_than_round_ones() -> None:
    points = known(seen(BODY))
    found = [bend(cut(points, rounding)) for rounding in (0.05, 0.2, 0.4, 0.6, 0.9)]
    assert found == sorted(found, reverse=True)
    assert found[0] > 1.5 * found[-1]


def test_size_place_and_attitude_do_not_count(rng: np.random.Generator) -> None:
    points = cut(known(seen(BODY)), 0.2)
    first = bend(points)
    larger = Ellipsoid(BODY.centre_m * 3, BODY.half_axes_m * 3, BODY.axes)
    assert bend(points * 3, larger) == pytest.approx(first, rel=1e-9)
    spin = Rotation.from_rotvec([0.2, 0.3, 0.9]).as_matrix()
    turned = Ellipsoid(spin @ BODY.centre_m, BODY.half_axes_m, BODY.axes @ spin.T)
    assert bend(points @ spin.T, turned) == pytest.approx(first, rel=1e-9)
    # other 4,000 of the points are drawn, and few of them lie on edges
    order = rng.permutation(len(points))
    assert bend(points[order]) == pytest.approx(first, rel=0.05)
    mirrored = Ellipsoid(BODY.centre_m, BODY.half_axes_m, BODY.axes[[1, 0, 2]])
    swapped = Ellipsoid(BODY.centre_m, BODY.half_axes_m[[1, 0, 2]], mirrored.axes)
    assert bend(points, swapped) == pytest.approx(first, rel=0.03)


@pytest.mark.parametrize("stride", [2, 4, 6])
def test_a_sparser_grid_tells_nearly_the_same(stride: int) -> None:
    grid = seen(BODY)
    whole = bend(cut(known(grid), 0.2))
    assert bend(cut(known(grid[::stride, ::stride]), 0.2)) == pytest.approx(whole, rel=0.05)


def test_holes_and_outliers_move_it_little(rng: np.random.Generator) -> None:
    points = cut(known(seen(BODY)), 0.2)
    whole = bend(points)
    hole = np.linalg.norm(points - points[len(points) // 2], axis=1) > 0.05
    assert bend(points[hole]) == pytest.approx(whole, rel=0.1)
    spoiled = points.copy()
    wild = rng.permutation(len(points))[: len(points) // 10]
    spoiled[wild] *= 1 + rng.choice([-1, 1], (len(wild), 1)) * rng.uniform(0.1, 0.3, (len(wild), 1))
    assert bend(spoiled) == pytest.approx(whole, rel=0.25)


def test_noise_is_taken_off(rng: np.random.Generator) -> None:
    grid = seen(BODY)
    inside = np.isfinite(grid).all(axis=-1)
    exact = cut(grid[inside], 0.2)
    noise = NoiseModel(0.0008, 7, 0.0, 1e-3)  # 3 mm at 2 m
    depth = np.full(inside.shape, np.nan)
    depth[inside] = exact[:, 2]
    error = noise.draw_m(depth, rng=rng)[inside]
    noisy = exact * (1 + error / exact[:, 2])[:, None]
    draws = np.column_stack([noise.draw_m(depth, rng=rng)[inside] for _ in range(4)])
    found = measure_relief(BODY, noisy, draws_m=draws)
    assert found is not None
    assert found.noise_bend_cubed > 0.01
    assert found.rough > 1.1 * relief(exact).rough
    assert roughness_3d(found) == pytest.approx(relief(exact).rough, abs=0.002)
    assert angularity_3d(found) == pytest.approx(bend(exact), rel=0.15)


def test_what_noise_or_pixels_hide_is_not_told() -> None:
    seen_well = {"rough": 0.01, "noise_rough": 0.0}
    assert np.isnan(angularity_3d(Relief(9.0, 1e3, facing=5000, **seen_well)))
    assert np.isnan(angularity_3d(Relief(9.0, 0.1, facing=100, **seen_well)))
    assert angularity_3d(Relief(-0.5, 0.6, facing=5000, **seen_well)) == 0
    assert roughness_3d(Relief(0.0, 0.0, rough=0.01, noise_rough=0.02, facing=5000)) == 0
    assert measure_relief(BODY, known(seen(BODY))[:100]) is None
