"""Finish of rocks and wet surfaces, and the light drawn for each scene, in closed form."""

import numpy as np
import pytest

from synth.light.drawn_sun import drawn_sun
from synth.light.rock_paint import rock_paint
from synth.light.wetness import highlight, wetted
from synth.scene.finish import Finish, draw_finishes
from synth.spec import convert_spec
from synth.spec.tints import TintsSpec

GREY = np.full(3, 0.5)


def line_of(finish, side_m):
    """Return the paint along z through the origin, (n, 3), and the places."""
    z = np.linspace(-0.05, 0.05, 2001).astype(np.float32)
    points = np.column_stack([0 * z, 0 * z, z]).astype(np.float32)
    return rock_paint(finish, GREY)(points, np.full(len(z), side_m, dtype=np.float32)), z


def test_a_vein_covers_its_width_whatever_the_pixel():
    vein = Finish(veins=np.array([[0.0, 0.0, 1.0, 0.01, 0.004]]))
    for side_m in (1e-4, 1e-3, 8e-3):
        factor, z = line_of(vein, side_m)
        cover = (factor[:, 0] - 1.0) / (0.72 / 0.5 - 1.0)
        # It sways by 4 mm sin(60 z), which stretches it by 1/(1 + 0.24 cos 60 z) along z.
        place = z[cover > 0.5 * cover.max()].mean() if side_m < 4e-3 else 0.008
        stretch = 1.0 / (1.0 + 0.24 * np.cos(60.0 * place))
        assert np.trapezoid(cover, z) == pytest.approx(0.004 * stretch, rel=0.02)


def test_layers_fade_as_the_mean_over_the_pixel():
    wave = 2.0 * np.pi / 0.01
    layers = Finish(layers=np.array([[0.0, 0.0, wave, 0.3]]))
    fine, z = line_of(layers, 1e-6)
    assert fine.mean() == pytest.approx(1.0, abs=1e-3)
    assert fine[:, 1].std() == pytest.approx(0.22, rel=0.01)
    coarse, _ = line_of(layers, 0.005)
    width = round(0.005 / (z[1] - z[0]))
    mean = np.convolve(fine[:, 0], np.ones(width) / width, mode="same")
    inner = slice(200, -200)
    np.testing.assert_allclose(coarse[inner, 0], mean[inner], atol=0.005)
    lost, _ = line_of(layers, 0.01)
    np.testing.assert_allclose(lost, 1.0, atol=1e-3)


def test_a_wet_surface_is_the_sum_of_its_reflections_in_the_film():
    # A share 1/n² of what is scattered leaves the film, the rest is scattered again:
    # ρ/n² Σ (ρ (1 − 1/n²))^k.
    for rho in (0.1, 0.5, 0.9):
        out = 1.0 / 1.33**2
        series = rho * out * sum((rho * (1.0 - out)) ** k for k in range(400))
        assert wetted(np.array([rho], np.float32), 1.0)[0] == pytest.approx(series, rel=1e-5)
    assert wetted(np.array([0.5], np.float32), 0.0)[0] == 0.5


def test_the_highlight_stands_where_the_sun_is_mirrored():
    up = np.array([[0.0, 0.0, 1.0]], dtype=np.float32)
    sun = np.array([0.6, 0.0, 0.8], dtype=np.float32)
    mirrored = highlight(up, np.array([[-0.6, 0.0, 0.8]], dtype=np.float32), sun)[0]
    fresnel = 0.0200593 + (1.0 - 0.0200593) * (1.0 - 0.8) ** 5
    assert mirrored == pytest.approx(fresnel * 68.0 / 8.0 * 0.8, rel=1e-4)
    assert highlight(up, up, sun)[0] < 0.1 * mirrored


def test_rocks_are_of_the_lithologies_that_are_named():
    spec = TintsSpec(lithologies=("basalt", "basalt", "basalt", "red"), veins=0.5, layers=0.25)
    drawn = draw_finishes(spec, 2000, rng=np.random.default_rng(1))
    share = np.mean([one.lithology == "basalt" for one in drawn])
    assert share == pytest.approx(0.75, abs=0.04)
    assert np.mean([len(one.veins) > 0 for one in drawn]) == pytest.approx(0.5, abs=0.05)
    assert np.mean([len(one.layers) > 0 for one in drawn]) == pytest.approx(0.25, abs=0.04)


def test_the_suns_of_scenes_fill_their_ranges():
    table = {"light": {"elevation_deg": [5, 60], "ambient": [0.2, 0.9]}}
    spec = convert_spec(table, where="test")
    suns = [drawn_sun(spec, index) for index in range(400)]
    heights = np.array([sun.elevation_deg for sun in suns])
    assert heights.mean() == pytest.approx(32.5, abs=2.5)
    assert 5.0 <= heights.min() < 7.0
    assert 58.0 < heights.max() <= 60.0
    assert {sun.azimuth_deg for sun in suns} == {140.0}
    # A range more leaves the other draws as they were.
    table["light"]["azimuth_deg"] = [0, 360]
    again = drawn_sun(convert_spec(table, where="test"), 3)
    assert again.elevation_deg == suns[3].elevation_deg
    assert drawn_sun(convert_spec({}, where="test"), 3) == spec.sun
