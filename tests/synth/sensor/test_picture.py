"""Grey levels: rounding, bits, the noise's own law, JPEG."""

import msgspec
import numpy as np
import pytest

from synth.sensor.exposure import eight_bits, take_picture
from synth.spec import SceneSpec
from synth.spec.sensor import SensorSpec


def test_ideal_sensor_rounds_and_draws_nothing(rng):
    light = np.arange(766).reshape(1, -1) / 765.0  # thirds of a grey level
    state = rng.bit_generator.state
    picture = take_picture(light, SensorSpec(), rng=rng)
    assert rng.bit_generator.state == state
    np.testing.assert_array_equal(picture, (np.arange(766)[None] + 1) // 3)


def test_twelve_bits_stand_in_the_upper_bits(rng):
    light = np.array([[0.0, 0.5, 1.0, 1.7]])
    picture = take_picture(light, SensorSpec(bits=12), rng=rng)
    assert picture.dtype == np.uint16
    np.testing.assert_array_equal(picture, [[0, 2048 * 16, 4095 * 16, 4095 * 16]])
    np.testing.assert_array_equal(eight_bits(picture), [[0, 128, 255, 255]])


def test_exposure_saturates_at_white(rng):
    picture = take_picture(np.array([[0.2, 0.6]]), SensorSpec(exposure=2.0), rng=rng)
    np.testing.assert_array_equal(picture, [[102, 255]])


@pytest.mark.parametrize(("full_well_e", "read_noise_e"), [(5000.0, 0.0), (20000.0, 200.0)])
def test_noise_has_the_photon_transfer_variance(rng, full_well_e, read_noise_e):
    # Var(level) = (G² (N L + σ²)) + 1/12 for rounding, G = levels per electron.
    light, count = 0.4, 400
    sensor = SensorSpec(full_well_e=full_well_e, read_noise_e=read_noise_e, bits=12)
    levels = take_picture(np.full((count, count), light), sensor, rng=rng) / 16.0
    gain = 4095.0 / full_well_e
    expected = gain**2 * (full_well_e * light + read_noise_e**2) + 1.0 / 12.0
    # The relative error of a variance from n values is √(2/n) = 0.35 %; four of them.
    assert levels.var() == pytest.approx(expected, rel=0.015)
    assert levels.mean() == pytest.approx(4095.0 * light, abs=4.0 * np.sqrt(expected) / count)


def test_jpeg_loses_more_at_lower_quality(rng):
    light = rng.uniform(0.3, 0.7, size=(64, 64))
    exact = take_picture(light, SensorSpec(), rng=rng).astype(float)

    def loss(quality):
        return np.abs(take_picture(light, SensorSpec(jpeg_quality=quality), rng=rng) - exact).mean()

    assert 0.0 < loss(95) < loss(50)


@pytest.mark.parametrize(
    ("table", "key"),
    [
        ({"sensor": {"read_noise_e": 5.0}}, "full_well_e"),
        ({"sensor": {"jpeg_quality": 80, "bits": 12}}, "jpeg_quality"),
        ({"sensor": {"bits": 10}}, "bits"),
        ({"noise": {"window_px": 6}}, "window_px"),
    ],
)
def test_specs_that_no_sensor_has_are_refused(table, key):
    with pytest.raises(msgspec.ValidationError, match=key):
        msgspec.convert(table, SceneSpec)
