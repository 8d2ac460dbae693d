"""Known errors of range are found again: their size, their window, and the ground's roughness."""

import numpy as np
import pytest
import scipy.ndimage as ndi

from rockshape.ground import Ground, NoiseModel, fit_ground
from rockshape.ground.range_noise import estimate_range_noise, estimate_roughness
from rockshape.observation import Observation
from rockshape.pipeline import measure
from tests import solids

CAMERA = solids.CAMERA
PIXEL_RAD = 1 / CAMERA.fx
CAMERA_HEIGHT_M = 1.5
FOCAL_BASELINE_PX_M = 100.0  # of a stereo pair of 500 px and 20 cm: 40 px at 2.5 m
LEVELS_PX = (0.05, 0.1, 0.2, 0.4, 0.8)


def ground_points(*, slope_rad: float = 0.0, ripple_m: float = 0.0) -> np.ndarray:
    """A plane 37 degrees below the axis, turned about it by a slope, with waves of 60 cm."""
    normal = np.array([0.8 * np.sin(slope_rad), -0.8 * np.cos(slope_rad), -0.6])
    rays = solids.rays(CAMERA)
    points = solids.plane_range(CAMERA, normal=normal, offset_m=-CAMERA_HEIGHT_M)
    ahead = np.cross([1.0, 0.0, 0.0], normal)
    for _ in range(30 if ripple_m else 0):  # where the ray meets n . p = -1.5 + ripple(p)
        ripple = ripple_m * np.cos(2 * np.pi / 0.6 * (points @ ahead + 0.3 * points[..., 0]))
        points = rays * ((-CAMERA_HEIGHT_M + ripple) / (rays @ normal))[..., None]
    return points


def measured(
    points: np.ndarray,
    disparity_px: float,
    rng: np.random.Generator,
    *,
    window_px: int = 7,
    step_px: float = 0.0625,
) -> tuple[np.ndarray, float]:
    """Points of a disparity in steps with errors even over a window, and the RMS error of 1/Z."""
    exact = FOCAL_BASELINE_PX_M / points[..., 2]
    white = rng.standard_normal(exact.shape)
    even = ndi.uniform_filter(white, window_px, mode="wrap") * window_px
    found = step_px * np.rint((exact + disparity_px * even) / step_px)
    depth = FOCAL_BASELINE_PX_M / found
    rms = np.sqrt(np.mean((found - exact) ** 2)) / FOCAL_BASELINE_PX_M
    return points / points[..., 2:] * depth[..., None], float(rms)


def with_slabs(points: np.ndarray, *, every_px: int, side_px: int) -> np.ndarray:
    """Points with slabs up to 25 cm high on a grid: over (side/every)² of the frame."""
    rows, cols = points.shape[:2]
    y, x = np.mgrid[:rows, :cols]
    slab = (x % every_px < side_px) & (y % every_px < side_px)
    return np.where(slab[..., None], points * 0.88, points)


def noise_of(points: np.ndarray) -> NoiseModel:
    ground = fit_ground(points, pixel_rad=PIXEL_RAD)
    assert ground is not None
    assert ground.noise is not None
    return ground.noise


GROUNDS = {
    "flat": ground_points(),
    "sloped": ground_points(slope_rad=0.25),
    "rippled": ground_points(ripple_m=0.02),
    "crowded": with_slabs(ground_points(), every_px=48, side_px=26),
}


@pytest.mark.parametrize("disparity_px", LEVELS_PX)
@pytest.mark.parametrize("ground", GROUNDS)
def test_known_noise_is_found(ground: str, disparity_px: float, rng: np.random.Generator) -> None:
    points, _ = measured(GROUNDS[ground], disparity_px, rng)
    expected = np.hypot(disparity_px, 0.0625 / np.sqrt(12)) / FOCAL_BASELINE_PX_M
    # 76,800 pixels in windows of 49 are 1,570 independent errors: 2 %, on half a frame 3 %
    assert noise_of(points).inverse_depth_sd_per_m == pytest.approx(expected, rel=0.1)


@pytest.mark.parametrize("window_px", [1, 3, 7, 11])
def test_the_window_of_the_errors_is_found(window_px: int, rng: np.random.Generator) -> None:
    points, _ = measured(ground_points(), 0.3, rng, window_px=window_px)
    found = noise_of(points).window_px
    assert found % 2 == 1
    assert abs(found - window_px) <= (0 if window_px == 1 else 2)


def test_the_errors_of_this_very_frame_are_found(rng: np.random.Generator) -> None:
    for _ in range(3):
        points, rms = measured(ground_points(), 0.2, rng, window_px=3)
        # windows of 9 px: what is left of chance is 1 %
        assert noise_of(points).inverse_depth_sd_per_m == pytest.approx(rms, rel=0.03)


def test_outliers_do_not_count(rng: np.random.Generator) -> None:
    points, rms = measured(ground_points(), 0.1, rng)
    points[rng.random(points.shape[:2]) < 0.01] *= 0.97
    points[rng.random(points.shape[:2]) < 0.05] = np.nan
    assert noise_of(points).inverse_depth_sd_per_m == pytest.approx(rms, rel=0.1)


def test_roughness_is_told_from_range_noise(rng: np.random.Generator) -> None:
    depth = np.tile(np.geomspace(1.5, 8.0, 96)[:, None], (1, 400))
    lever = CAMERA_HEIGHT_M * depth
    error = rng.normal(scale=6e-4, size=depth.shape)
    height = lever * error + rng.normal(scale=0.004, size=depth.shape)
    sd_per_m, window_px = estimate_range_noise(height / lever, lever)
    rough_m = estimate_roughness(height.ravel(), lever.ravel(), range_sd_per_m=sd_per_m)
    # 6,400 values in a bin are known to 1 %, differences of them to 2 %; the two parts trade some
    assert sd_per_m == pytest.approx(6e-4, rel=0.06)
    assert window_px == 1
    assert rough_m == pytest.approx(0.004, rel=0.1)


def test_exact_range_has_no_noise() -> None:
    noise = noise_of(ground_points())
    assert noise.inverse_depth_sd_per_m < 1e-12  # rounding
    assert noise.rough_m < 1e-12
    assert noise.is_fine(2.0)
    assert not NoiseModel(1e-3, 7, 0.0, PIXEL_RAD).is_fine(2.0)


@pytest.mark.filterwarnings("error::RuntimeWarning")
def test_exact_range_whose_rounding_vanishes_somewhere_has_no_noise(
    rng: np.random.Generator,
) -> None:
    depth = np.tile(np.linspace(2.0, 3.0, 60)[:, None], (1, 600))
    rounding = rng.normal(scale=6e-17, size=depth.shape)
    rounding[:12] = np.where(rng.random((12, 600)) < 0.01, 6e-17, 0.0)  # nearest: in one bin
    sd_per_m, window_px = estimate_range_noise(rounding, CAMERA_HEIGHT_M * depth)
    assert (sd_per_m, window_px) == (0.0, 1)


def test_exact_range_on_ripples_is_still_exact() -> None:
    noise = noise_of(GROUNDS["rippled"])
    assert noise.inverse_depth_sd_per_m * FOCAL_BASELINE_PX_M < 0.01


def test_too_few_pixels_tell_nothing(rng: np.random.Generator) -> None:
    error = rng.normal(scale=1e-3, size=(10, 10))
    assert estimate_range_noise(error, np.ones_like(error)) == (0.0, 1)
    assert estimate_range_noise(np.abs(error), np.ones_like(error)) == (0.0, 1)
    assert estimate_roughness(np.abs(error).ravel(), np.ones(100), range_sd_per_m=0.0) == 0


def test_draws_have_the_deviation_and_the_window_they_say(rng: np.random.Generator) -> None:
    depth = np.full((300, 300), 4.0)
    model = NoiseModel(0.002, 7, 0.0, 1e-3)
    draw = model.draw_m(depth, rng=rng)
    assert model.depth_sd_m(depth) == pytest.approx(0.002 * 16)
    # 90,000 pixels in windows of 49
    assert draw.std() == pytest.approx(0.002 * 16, rel=0.05)
    apart = [float(np.mean(draw[:, lag:] * draw[:, : 300 - lag])) for lag in (0, 3, 7)]
    assert apart[1] / apart[0] == pytest.approx(1 - 3 / 7, abs=0.06)
    assert apart[2] / apart[0] == pytest.approx(0, abs=0.08)


@pytest.mark.parametrize("given", [False, True], ids=["rocks to find", "rocks given"])
def test_a_measurement_estimates_its_ground_once(
    given: bool, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    centre = np.array([0.0, 0.0, 2.4])
    rock = solids.ellipsoid_range(
        CAMERA, centre_m=centre, half_axes_m=np.full(3, 0.15), axes=np.eye(3)
    )
    points, _ = measured(solids.nearest(ground_points(), rock), 0.05, rng)
    labels = np.where(np.isfinite(rock[..., 2]), 1, 0).astype(np.int32) if given else None
    grounds: list[Ground | None] = []

    def counted(points_m: np.ndarray, *, pixel_rad: float) -> Ground | None:
        grounds.append(fit_ground(points_m, pixel_rad=pixel_rad))
        return grounds[-1]

    monkeypatch.setattr("rockshape.segmentation.robust.fit_ground", counted)
    image = np.full(CAMERA.shape, 0.5, dtype=np.float32)
    observation = Observation(image=image, points_m=points, camera=CAMERA)
    measurement = measure(observation, method="robust", labels=labels)
    assert len(measurement.rocks) == 1
    assert len(grounds) == 1
    assert measurement.ground is grounds[0]
