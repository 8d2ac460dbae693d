"""Light on a height field against closed forms and rays marched one by one."""

from itertools import pairwise

import cv2
import numpy as np
import pytest

from synth.bed.picture.photograph import Photograph, photograph
from synth.bed.picture.shadows import normals_of, shadow_depth, sky_share
from synth.noise import cells, fractal


@pytest.fixture
def blocks():
    """Boxes and domes of different heights on a rough ground."""
    rng = np.random.default_rng(3)
    height = 3.0 * cv2.GaussianBlur(rng.standard_normal((72, 88)), (0, 0), 3.0)
    height[20:30, 30:44] += 9.0
    height[50:56, 12:20] += 14.0
    x, y = np.meshgrid(np.arange(88.0), np.arange(72.0))
    height += np.sqrt(np.maximum(81.0 - (x - 66) ** 2 - (y - 45) ** 2, 0.0))
    return height.astype(np.float32)


def marched(height, per_px, azimuth, elevation):
    """Mask of samples from which a ray towards the sun meets a higher sample."""
    shaded = np.zeros(height.shape, dtype=bool)
    rows, columns = height.shape
    for row in range(rows):
        for column in range(columns):
            for step in np.arange(0.5, 130.0, 0.25):
                x, y = column + step * np.cos(azimuth), row + step * np.sin(azimuth)
                j, i = round(x), round(y)
                if not (0 <= i < rows and 0 <= j < columns):
                    break
                if (i, j) != (row, column) and height[i, j] > height[row, column] + step * np.tan(
                    elevation
                ) / per_px:
                    shaded[row, column] = True
                    break
    return shaded


@pytest.mark.parametrize("azimuth_deg", [10.0, 80.0, 135.0, 200.0, 333.0])
def test_cast_shadows_are_those_of_marched_rays(blocks, azimuth_deg):
    azimuth, elevation = np.deg2rad(azimuth_deg), np.deg2rad(22.0)
    depth = shadow_depth(blocks, 1, azimuth_rad=azimuth, elevation_rad=elevation)
    ours, theirs = depth > 0.0, marched(blocks, 1, azimuth, elevation)
    assert 0.1 < theirs.mean() < 0.6
    # Both step over samples; at the borders of a shadow they may round to neighbours.
    box = np.ones((3, 3), np.uint8)
    grown = [cv2.dilate(mask.astype(np.uint8), box) > 0 for mask in (ours, theirs)]
    shrunk = [cv2.erode(mask.astype(np.uint8), box) > 0 for mask in (ours, theirs)]
    assert (ours == theirs).mean() > 0.93
    assert (ours & ~grown[1]).mean() < 0.004
    assert (theirs & ~grown[0]).mean() < 0.004
    assert (shrunk[0] & ~theirs).mean() < 0.004


@pytest.mark.parametrize("per_px", [1, 2])
def test_a_walls_shadow_is_as_long_as_its_height_over_the_tangent(per_px):
    height = np.zeros((9, 90), dtype=np.float32)
    height[:, 40] = 6.0
    depth = shadow_depth(height, per_px, azimuth_rad=0.0, elevation_rad=np.deg2rad(40.0))
    length = per_px * 6.0 / np.tan(np.deg2rad(40.0))
    assert (depth[4] > 0.0).sum() == int(length)
    assert (depth[4, 41:] == 0.0).all()
    steps = np.arange(1, int(length))
    assert depth[4, 40 - steps] == pytest.approx(
        6.0 - steps / per_px * np.tan(np.deg2rad(40.0)), abs=1e-4
    )


@pytest.mark.parametrize("per_px", [1, 2])
def test_normals_of_a_slope(per_px):
    x, y = np.meshgrid(np.arange(20.0), np.arange(12.0))
    height = (0.4 * x - 0.3 * y) / per_px
    normals = normals_of(height.astype(np.float32), per_px)[1:-1, 1:-1]
    expected = np.array([-0.4, 0.3, 1.0]) / np.sqrt(1.25)
    assert normals == pytest.approx(np.broadcast_to(expected, normals.shape), abs=1e-5)


def test_level_ground_sees_the_whole_sky_and_a_walls_foot_half_of_it():
    height = np.zeros((80, 80), dtype=np.float32)
    assert sky_share(height, 1) == pytest.approx(1.0)
    height[:, 40:] = 1000.0
    share = sky_share(height, 1)
    assert share[40, 39] == pytest.approx(5.0 / 8.0, abs=0.01)  # three of eight directions blocked
    assert share[40, 5] == pytest.approx(1.0)
    assert share[40, 60] == pytest.approx(1.0)


def test_fractal_noise_has_the_spectrum_that_was_asked_for():
    field = fractal(256, 2.5, np.random.default_rng(0))
    assert field.std() == pytest.approx(1.0, abs=1e-3)
    power = np.abs(np.fft.fft2(field)) ** 2
    frequency = np.hypot(*np.meshgrid(np.fft.fftfreq(256), np.fft.fftfreq(256)))
    edges = np.geomspace(0.02, 0.4, 12)
    means = [power[(frequency >= low) & (frequency < high)].mean() for low, high in pairwise(edges)]
    slope = np.polyfit(np.log(np.sqrt(edges[1:] * edges[:-1])), np.log(means), 1)[0]
    assert slope == pytest.approx(-2.5, abs=0.15)


def test_cells_are_those_of_the_nearest_point_on_a_torus():
    near, second, number, right, below = cells(32, 8, np.random.default_rng(2))
    x, y = np.meshgrid(np.arange(32.0), np.arange(32.0))
    points = {}
    for key in np.unique(number):
        i, j = np.argwhere(number == key)[0]
        points[key] = (j - right[i, j], i - below[i, j])
    assert len(points) > 12
    gaps = np.stack(
        [np.hypot((x - px + 16) % 32 - 16, (y - py + 16) % 32 - 16) for px, py in points.values()]
    )
    ordered = np.sort(gaps, axis=0)
    assert near == pytest.approx(ordered[0], abs=1e-3)
    assert (second <= ordered[1] + 1e-3).all()


@pytest.mark.parametrize("grey", [True, False])
def test_a_photograph_of_even_light_has_the_brightness_that_was_asked_for(grey):
    photo = Photograph(
        brightness=0.5, contrast=1.2, blur_px=0.5, sharpening=0.5, noise=0.02, jpeg_quality=None,
        grey=grey, vignetting=0.0,
    )  # fmt: skip
    light = np.full((64, 64, 3), 0.2, dtype=np.float32)
    picture = photograph(light, photo, np.random.default_rng(0))
    assert picture.mean() == pytest.approx(127.5, abs=1.0)
    assert picture[..., 0].std() == pytest.approx(0.02 * 255.0, rel=0.25)
    assert (picture[..., 0] == picture[..., 1]).all() == grey
