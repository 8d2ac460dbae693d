"""Development of light into levels: tone curves, balance, blur and exposure in closed form."""

import numpy as np
import pytest

from synth.sensor.development import Development, blurred, draw_development, srgb, toned
from synth.sensor.exposure import take_picture
from synth.spec import convert_spec
from synth.spec.sensor import SensorSpec


def test_srgb_is_the_standards_curve():
    # Values of IEC 61966-2-1: the line, its end, and 18 % grey, which is level 118 of 255.
    np.testing.assert_allclose(
        srgb(np.array([0.0, 0.001, 0.0031308, 0.18, 0.5, 1.0])),
        [0.0, 0.01292, 0.040449936, 0.4613561, 0.7353569, 1.0],
        atol=2e-7,
    )
    level = take_picture(
        np.full((2, 2), 0.18, dtype=np.float32),
        SensorSpec(),
        rng=np.random.default_rng(0),
        development=Development(tone="srgb"),
    )
    assert (level == 118).all()


def test_gamma_and_filmic_curves():
    light = np.array([[0.25, 1.0, 4.0]])
    found = toned(light, Development(tone="gamma", gamma=2.0))
    np.testing.assert_allclose(found, [[0.5, 1.0, 1.0]])
    # x (2.51 x + 0.03)/(x (2.43 x + 0.59) + 0.14) at 1 is 2.54/3.16: white is not yet burnt out.
    found = toned(light, Development(tone="filmic"))
    np.testing.assert_allclose(found[0, 1], srgb(np.array(2.54 / 3.16)))
    assert found[0, 0] < found[0, 1] < found[0, 2] <= 1.0


def test_balance_multiplies_the_channels_of_colour_alone():
    wrong = Development(balance=(1.2, 1.0, 0.8))
    found = toned(np.full((1, 1, 3), 0.5), wrong)
    np.testing.assert_allclose(found[0, 0], [0.6, 0.5, 0.4])
    assert toned(np.full((1, 1), 0.5), wrong)[0, 0] == 0.5


def test_blur_spreads_a_point_as_a_normal_density():
    point = np.zeros((41, 41), dtype=np.float32)
    point[20, 20] = 1.0
    spread = blurred(point, Development(blur_px=1.5))
    assert spread.sum() == pytest.approx(1.0, abs=1e-5)
    variance = (spread.sum(axis=0) * (np.arange(41) - 20.0) ** 2).sum()
    assert variance == pytest.approx(1.5**2, rel=0.03)


def test_settings_are_drawn_for_each_view_from_their_ranges():
    image = {"exposure_stops": [-1.0, 1.0], "blur_px": [0.5, 1.5], "white_balance": 0.1}
    spec = convert_spec({"image": image}, where="test")
    drawn = [draw_development(spec, scene=0, view=view) for view in range(400)]
    stops = np.log2([one.gain for one in drawn])
    assert -1.0 <= stops.min() < -0.9
    assert 0.9 < stops.max() <= 1.0
    assert np.log([one.balance[0] for one in drawn]).std() == pytest.approx(0.1, rel=0.15)
    assert draw_development(spec, scene=0, view=7) == drawn[7]
    assert draw_development(convert_spec({}, where="test"), scene=0, view=7) == Development()


def test_jpeg_keeps_the_order_of_red_green_and_blue():
    light = np.empty((32, 32, 3), dtype=np.float32)
    light[:] = [0.8, 0.5, 0.2]
    found = take_picture(light, SensorSpec(jpeg_quality=95), rng=np.random.default_rng(0))
    np.testing.assert_allclose(found.mean(axis=(0, 1)) / 255.0, [0.8, 0.5, 0.2], atol=0.01)
