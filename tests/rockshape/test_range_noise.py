import numpy as np
import pytest

from rockshape.ground import fit_plane
from rockshape.ground.pixel_noise import RangeNoise, estimate_range_noise
from tests import solids

NORMAL = np.array([0.0, -0.8, -0.6])


def ground_with(noise: RangeNoise | None, rng: np.random.Generator) -> np.ndarray:
    points = solids.plane_range(solids.CAMERA, normal=NORMAL, offset_m=-1.5)
    if noise is None:
        return points
    depth = points[..., 2] + noise.draw_m(points[..., 2], rng=rng)
    return solids.CAMERA.unproject(depth)


@pytest.mark.parametrize("window_px", [1, 7])
@pytest.mark.parametrize("per_square_m", [0.0005, 0.003])
def test_the_noise_drawn_is_the_noise_found(
    window_px: int, per_square_m: float, rng: np.random.Generator
) -> None:
    points = ground_with(RangeNoise(per_square_m, window_px), rng)
    ground = fit_plane(points)
    assert ground is not None
    rocks = np.zeros(points.shape[:2], dtype=bool)
    found = estimate_range_noise(points, ground, rocks)
    assert found is not None
    # 76,800 pixels in windows of 49: some 1,500 independent values
    assert found.per_square_m == pytest.approx(per_square_m, rel=0.06)
    assert abs(found.window_px - window_px) <= (0 if window_px == 1 else 2)


def test_rocks_and_stones_do_not_count(rng: np.random.Generator) -> None:
    points = ground_with(RangeNoise(0.001, 7), rng)
    points[50:120, 80:200] *= 0.9
    rocks = np.zeros(points.shape[:2], dtype=bool)
    rocks[50:120, 80:200] = True
    stones = rng.random(points.shape[:2]) < 0.002
    points[stones] *= 0.97
    ground = fit_plane(np.where(rocks[..., None], np.nan, points))
    assert ground is not None
    found = estimate_range_noise(points, ground, rocks)
    assert found is not None
    assert found.per_square_m == pytest.approx(0.001, rel=0.08)


def test_exact_range_has_none_and_no_ground_tells_nothing(rng: np.random.Generator) -> None:
    points = ground_with(None, rng)
    ground = fit_plane(points)
    assert ground is not None
    none = np.zeros(points.shape[:2], dtype=bool)
    found = estimate_range_noise(points, ground, none)
    assert found is not None
    assert found.per_square_m < 1e-12  # rounding
    assert estimate_range_noise(points, ground, ~none) is None


def test_draws_have_the_deviation_and_the_window_they_say(rng: np.random.Generator) -> None:
    depth = np.full((300, 300), 4.0)
    draw = RangeNoise(0.002, 7).draw_m(depth, rng=rng)
    # 90,000 pixels in windows of 49
    assert draw.std() == pytest.approx(0.002 * 16, rel=0.05)
    apart = [float(np.mean(draw[:, lag:] * draw[:, : 300 - lag])) for lag in (0, 3, 7)]
    assert apart[1] / apart[0] == pytest.approx(1 - 3 / 7, abs=0.06)
    assert apart[2] / apart[0] == pytest.approx(0, abs=0.08)
