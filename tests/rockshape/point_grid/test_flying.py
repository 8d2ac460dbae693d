"""Flying pixels are told between surfaces, and nowhere on one."""

import cv2
import numpy as np
import pytest
import scipy.ndimage as ndi

import rockshape
import synth
from rockshape.point_grid.flying import flying_pixels
from tests import solids

PIXEL_RAD = 1 / 500  # of solids.CAMERA


def told(depth_m: np.ndarray) -> np.ndarray:
    return flying_pixels(solids.CAMERA.unproject(depth_m), pixel_rad=PIXEL_RAD)


def sphere(radius_px: float, shift: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Z-depth of a sphere 2 m away before a plane, and its pixels."""
    radius_m = radius_px * 2 / 500
    ball = solids.ellipsoid_range(
        solids.CAMERA,
        centre_m=np.array([shift / 250, shift / 350, 2 + radius_m]),
        half_axes_m=np.full(3, radius_m),
        axes=np.eye(3),
    )
    plane = solids.plane_range(solids.CAMERA, normal=np.array([0, 0, 1.0]), offset_m=3 + radius_m)
    depth_m = solids.nearest(ball, plane)[..., 2]
    return depth_m, depth_m == ball[..., 2]


def mixed(depth_m: np.ndarray, side_px: int) -> np.ndarray:
    """Mean depth of the square that a pixel sees."""
    return np.asarray(cv2.blur(depth_m, (side_px, side_px), borderType=cv2.BORDER_REPLICATE))


def test_pixels_that_see_both_sides_of_a_step_fly() -> None:
    depth_m = 3.0 + 1e-4 * np.add.outer(np.arange(240.0), np.arange(320.0))
    depth_m[80:160, 100:200] -= 1.0
    found = told(mixed(depth_m, 3))
    expected = np.zeros_like(found)  # a footprint of 3 px mixes one pixel on either side
    for edge in (79, 159):
        expected[edge : edge + 2, 99:201] = True
    for edge in (99, 199):
        expected[79:161, edge : edge + 2] = True
    corners = ndi.binary_dilation(np.isin(np.arange(240), (79, 80, 159, 160))[:, None]
                                  & np.isin(np.arange(320), (99, 100, 199, 200)))  # fmt: skip
    np.testing.assert_array_equal(found[~corners], expected[~corners])
    assert not told(depth_m).any()


@pytest.mark.parametrize("radius_px", [10, 20, 40, 80, 110])
def test_exact_range_of_a_sphere_has_hardly_any(radius_px: float) -> None:
    for shift in (0.0, 0.31):
        depth_m, ball = sphere(radius_px, shift)
        found = told(depth_m)
        assert not found[~ball].any()
        assert found.sum() < 0.005 * ball.sum()


@pytest.mark.parametrize("radius_px", [20, 40, 80])
def test_the_limb_of_a_sphere_flies_where_pixels_are_wide(radius_px: float) -> None:
    depth_m, ball = sphere(radius_px)
    flown = np.abs(mixed(depth_m, 2) - depth_m) > 0.2
    found = told(mixed(depth_m, 2))
    assert found[flown].mean() > 0.9
    assert found[~flown].sum() < 0.02 * ball.sum()


@pytest.mark.parametrize("incidence_deg", [0, 60, 80, 85, 87])
def test_a_plane_has_none_however_steep(incidence_deg: float) -> None:
    tilt = np.radians(incidence_deg)
    normal = np.array([0, np.sin(tilt), np.cos(tilt)])
    points = solids.plane_range(solids.CAMERA, normal=normal, offset_m=2 * np.cos(tilt))
    assert not flying_pixels(points, pixel_rad=PIXEL_RAD).any()


@pytest.mark.parametrize("step_px", [1.0, 0.25, 1 / 16])
def test_steps_of_a_disparity_are_none(step_px: float) -> None:
    depth_m, ball = sphere(80)
    steep = solids.plane_range(solids.CAMERA, normal=np.array([0, 0.98, 0.2]), offset_m=1.2)[..., 2]
    for surface in (np.where(ball, depth_m, 3.4), np.where(steep > 0, steep, np.nan)):
        disparity = 500 * 0.1 / surface
        found = told(50 / np.maximum(np.rint(disparity / step_px) * step_px, step_px))
        assert found.sum() < 0.001 * found.size


def test_noise_and_holes_are_none(rng: np.random.Generator) -> None:
    depth_m, _ = sphere(80)
    noisy = depth_m + 0.02 * rng.standard_normal(depth_m.shape)
    assert told(np.where(depth_m < 3, noisy, np.nan)).mean() < 1e-4
    noisy[rng.random(depth_m.shape) < 0.2] = np.nan
    assert told(noisy).mean() < 1e-3
    assert not told(np.full((240, 320), np.nan)).any()
    assert flying_pixels(np.ones((2, 3, 3)), pixel_rad=PIXEL_RAD).shape == (2, 3)


@pytest.mark.parametrize("method", ["paper", "robust"])
def test_flying_pixels_are_left_out_before_any_fit_and_counted(method: str) -> None:
    depth_m, ball = sphere(60)
    labels, flown = ball.astype(np.int32), mixed(depth_m, 3)
    measured = rockshape.measure(range_m=flown, camera=solids.CAMERA, labels=labels, method=method)
    row = measured.to_frame().iloc[0]
    count = int((told(flown) & ball).sum())
    assert count > 100
    assert row["flying_points"] >= count
    assert row["range_points"] + row["flying_points"] + row["spike_points"] == ball.sum()


def test_values_hold_on_a_sphere_whose_limb_flies() -> None:
    depth_m, ball = sphere(60)
    row, exact = (
        rockshape.measure(range_m=each, camera=solids.CAMERA, labels=ball.astype(np.int32))
        .to_frame()
        .iloc[0]
        for each in (mixed(depth_m, 3), depth_m)
    )
    for name in ("axis_a_m", "axis_b_m", "axis_c_m", "sphericity_3d"):
        assert row[name] == pytest.approx(exact[name], rel=0.05), name


def test_a_time_of_flight_cameras_mixed_pixels_are_told() -> None:
    scene = synth.make_scene(
        site="plain",
        rocks={"count": 4, "family": "superellipsoid", "diameter_m": (0.05, 0.09)},
        camera={"preset": "imp", "distance_m": 1.8},
        seed=10007,
    )
    exact, seen = scene.render(0), scene.render(0, noise="tof")
    rock = np.asarray(seen.labels) > 0
    names = ("fx", "fy", "cx", "cy", "width", "height")
    camera = rockshape.Camera(**{name: getattr(seen.camera, name) for name in names})
    range_m = np.linalg.norm(camera.unproject(exact.depth_m), axis=-1)
    points_m = camera.unproject(seen.depth_m)
    error_m = np.abs(np.linalg.norm(points_m, axis=-1) - range_m)
    jump_m = ndi.maximum_filter(range_m, 3) - ndi.minimum_filter(range_m, 3)
    # noise is some 4 mm: a pixel that is off by six of them, and a tenth of the jump beside it
    flown = rock & (error_m > 0.025) & (error_m > 0.1 * jump_m) & (jump_m > 0.05)
    found = flying_pixels(points_m, pixel_rad=1 / camera.fx)
    assert flown.sum() > 50
    assert found[flown].mean() > 0.5
    assert (found & rock & (jump_m < 0.02)).sum() < 0.001 * rock.sum()
    assert (
        flying_pixels(camera.unproject(exact.depth_m), pixel_rad=1 / camera.fx)[rock].mean() < 0.005
    )
