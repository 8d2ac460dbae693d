"""Lidar: spacing of lines and shots, and the probability of a return."""

import numpy as np
import pytest

from synth.camera.camera import RenderCamera
from synth.camera.presets import PRESETS
from synth.camera.projection import pixel_rays
from synth.sensor.echo import Echo
from synth.sensor.lidar import LidarOptions, lidar_range_m, shot_pixels

CAMERA = RenderCamera(fx=1000.0, fy=1000.0, cx=255.5, cy=255.5, width=512, height=512)


def test_lines_lie_at_even_angles():
    rows, columns = shot_pixels(CAMERA, LidarOptions(line_deg=1.0, step_deg=0.01))
    middle = np.unique(rows[np.abs(columns - CAMERA.cx) < 1.0])
    # 511/2 px at f = 1000 px reach atan(0.2555) = 14.33°: lines −14 … 14.
    expected = np.rint(CAMERA.cy + CAMERA.fy * np.tan(np.deg2rad(np.arange(-14, 15))))
    np.testing.assert_array_equal(middle, expected)


def test_shots_lie_at_even_azimuths():
    rows, columns = shot_pixels(CAMERA, LidarOptions(line_deg=1.0, step_deg=2.0))
    level = columns[rows == 256]  # line 0; a pixel's row holds one line alone
    expected = np.rint(CAMERA.cx + CAMERA.fx * np.tan(np.deg2rad(np.arange(-14, 15, 2))))
    np.testing.assert_array_equal(np.sort(level), expected)


@pytest.mark.parametrize("preset", ["imp", "mer-hazcam"])
def test_every_shot_is_within_half_a_pixel_of_its_line(preset):
    camera, options = PRESETS[preset].camera, LidarOptions(line_deg=0.8, step_deg=0.5)
    rows, columns = shot_pixels(camera, options)
    across, down = (part.ravel() for part in pixel_rays(camera))
    lines = np.rad2deg(np.arctan2(down[rows], np.hypot(1.0, across[columns]))) / options.line_deg
    off = np.abs(lines - np.rint(lines)) * np.deg2rad(options.line_deg)
    assert off.max() <= 0.5001 / camera.fy  # no angle is larger than that of the central pixel


def test_a_shot_returns_with_the_probability_of_a_photon(rng):
    """A plane at 60°: n = N ρ cos θ/r², and e⁻ⁿ of the shots are lost."""
    photons, albedo, range_m = 100.0, 0.5, 5.0
    signal = albedo * np.cos(np.deg2rad(60.0)) / range_m**2
    echo = Echo(np.full((200, 200), range_m), np.full((200, 200), signal))
    rows, columns = np.divmod(np.arange(200 * 200), 200)
    options = LidarOptions(photons=photons, sd_m=0.02, step_m=0.0)
    found = lidar_range_m(echo, rows, columns, options, rng=rng)
    lost = np.exp(-photons * signal)  # 0.37: known to 0.0024 of 40,000 shots; four of them
    assert np.isnan(found).mean() == pytest.approx(lost, abs=0.01)
    known = found[np.isfinite(found)]
    assert known.mean() == pytest.approx(range_m, abs=4 * 0.02 / np.sqrt(known.size))
    assert known.std() == pytest.approx(0.02, rel=0.02)


def test_between_shots_is_nothing(rng):
    echo = Echo(np.full((6, 6), 2.0), np.full((6, 6), 1.0))
    found = lidar_range_m(
        echo, np.array([1, 3]), np.array([2, 4]), LidarOptions(step_m=0.001), rng=rng
    )
    assert np.isfinite(found).sum() == 2
    np.testing.assert_allclose(found[[1, 3], [2, 4]], 2.0, atol=0.06)
