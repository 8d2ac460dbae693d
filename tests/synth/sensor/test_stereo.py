"""The stereo camera's error: its size, its reach, its steps and its holes."""

import numpy as np
import pytest

from synth.errors import SpecError
from synth.sensor import rig as rig_module
from synth.sensor.occlusion import contrast, half_occluded
from synth.sensor.rig import Rig, rig_of
from synth.sensor.stereo import even_noise, modelled_depth_m, pull
from synth.spec.sensor import NoiseSpec

RIG = Rig(focal_px=1000.0, baseline_m=0.2)
SIZE = 420


def checkered(shape):
    return np.indices(shape).sum(axis=0) % 2 * 0.5


def test_disparity_and_depth_are_each_others_inverse(rng):
    depth_m = rng.uniform(1.0, 30.0, size=(5, 7))
    np.testing.assert_allclose(RIG.depth_m(RIG.disparity_px(depth_m)), depth_m, rtol=1e-12)
    assert np.isnan(RIG.depth_m(np.array([0.0, -1.0, np.nan]))).all()


def test_sigma_of_the_notes():
    # imp at 5 m: 5.2 cm; msl-navcam at 10 m: 6.2 cm (their last digit).
    assert rig_of("imp").depth_sd_m(np.array(5.0), 0.32) == pytest.approx(0.052, abs=5e-4)
    assert rig_of("msl-navcam").depth_sd_m(np.array(10.0), 0.32) == pytest.approx(0.062, abs=5e-4)


@pytest.mark.parametrize("depth_m", [2.0, 5.0])
def test_error_is_the_formulas(rng, depth_m):
    exact = np.full((SIZE, SIZE), depth_m)
    noise = NoiseSpec(kind="stereo", step_px=0.0)
    error = modelled_depth_m(exact, checkered(exact.shape), RIG, noise, rng=rng) - depth_m
    measured = error[~np.isnan(error)]
    expected = RIG.depth_sd_m(np.array(depth_m), 0.32)
    # (420/7)² = 3600 independent values: σ is known to 1/√7200 = 1.2 %; and the next order of
    # Z = f B/d adds (σ_Z/Z)², below 0.1 %.
    assert measured.std() == pytest.approx(float(expected), rel=0.04)


def test_noise_is_even_over_the_window(rng):
    window = 7
    noise = even_noise((700, 700), window, rng=rng)
    assert noise.std() == pytest.approx(1.0, rel=0.03)
    for lag in (1, 3, 5, 7, 10):
        found = np.mean(noise[:, lag:] * noise[:, :-lag])
        # 10,000 independent windows: a correlation is known to 0.01; four of them.
        assert found == pytest.approx(max(0.0, 1.0 - lag / window), abs=0.04)


def test_disparity_comes_in_steps(rng):
    exact = np.full((60, 60), 4.0)
    noise = NoiseSpec(kind="stereo", step_px=0.25)
    found = RIG.disparity_px(modelled_depth_m(exact, checkered((60, 60)), RIG, noise, rng=rng))
    known = found[~np.isnan(found)]
    np.testing.assert_allclose(known, np.rint(known * 4) / 4, rtol=1e-12)
    assert len(np.unique(known.round(6))) > 3


def test_no_disparity_noise_is_the_exact_depth_outside_the_holes(rng):
    exact = rng.uniform(3.0, 3.01, size=(40, 200))
    noise = NoiseSpec(kind="stereo", disparity_px=0.0, step_px=0.0, min_texture=0.0)
    found = modelled_depth_m(exact, checkered(exact.shape), RIG, noise, rng=rng)
    known = ~np.isnan(found)
    np.testing.assert_allclose(found[known], exact[known], rtol=1e-12)
    assert not known[:, :66].any()  # disparity 66 px: the right frame's edge
    assert known[:, 68:].all()


def test_a_near_slab_hides_the_disparity_difference_to_its_left():
    # Ground at 20 px, a slab at 50 px over columns 100 … 139: it lands on 50 … 89; ground lands
    # there from columns 70 … 109, of which 70 … 99 are seen in the left picture only.
    disparity_px = np.full((3, 200), 20.0)
    disparity_px[:, 100:140] = 50.0
    hidden = half_occluded(disparity_px)
    expected = np.zeros(200, dtype=bool)
    expected[:20] = True  # lands outside the right picture
    expected[70:100] = True
    np.testing.assert_array_equal(hidden, np.tile(expected, (3, 1)))


def test_ground_seen_past_a_thin_pole_is_no_hole():
    # A pole of 4 columns at 60 px lands on 40 … 43; ground hidden: columns 60 … 63 alone, and
    # what lies between them and the pole is seen past it.
    disparity_px = np.full((1, 200), 20.0)
    disparity_px[:, 100:104] = 60.0
    assert np.flatnonzero(half_occluded(disparity_px)[0]).tolist() == [*range(20), *range(60, 64)]


def test_sky_is_hidden_and_hides_nothing():
    disparity_px = np.full((1, 80), 10.0)
    disparity_px[:, 40:50] = np.nan
    assert np.flatnonzero(half_occluded(disparity_px)[0]).tolist() == [*range(10), *range(40, 50)]


def test_slanted_ground_hides_nothing_of_itself():
    disparity_px = np.linspace(30.0, 60.0, 300)[None]  # nearer to the right: lands in order
    assert not half_occluded(disparity_px)[0, 61:].any()


def test_texture_is_change_along_the_row():
    stripes = np.tile(np.arange(40) % 2 * 20.0 / 255.0, (40, 1))
    # Each step is 20 grey levels.
    np.testing.assert_allclose(contrast(stripes, 7)[10:30, 10:30], 20.0)
    np.testing.assert_allclose(contrast(stripes.T.copy(), 7), 0.0)


def test_weak_texture_is_a_hole(rng):
    light = checkered((60, 200))
    light[:, 120:] = 0.5
    found = modelled_depth_m(np.full((60, 200), 5.0), light, RIG, NoiseSpec(), rng=rng)
    assert not np.isnan(found[:, 42:116]).any()
    assert np.isnan(found[:, 124:]).all()


def test_one_eye_is_refused(monkeypatch):
    import dataclasses

    lone = dataclasses.replace(rig_module.PRESETS["imp"], baseline_m=None)
    monkeypatch.setitem(rig_module.PRESETS, "imp", lone)
    with pytest.raises(SpecError, match=r"noise\.kind.*two eyes.*'imp'"):
        rig_of("imp")


def test_the_error_grows_where_the_texture_is_weak(rng):
    # Columns change by 127.5 grey levels on the left and by 2.55 on the right half.
    exact = np.full((300, 840), 5.0)
    light = checkered(exact.shape)
    light[:, 420:] = 0.5 + (light[:, 420:] - 0.25) * 0.02
    noise = NoiseSpec(kind="stereo", disparity_px=0.1, weak_texture=5.1, step_px=0.0)
    found = RIG.disparity_px(modelled_depth_m(exact, light, RIG, noise, rng=rng)) - 40.0
    # c₀/c is 0.04 and 2: σ_d √(1 + c₀²/c²). 40 × 50 windows: σ is known to 1.6 %; four of them.
    assert np.nanstd(found[:, :410]) == pytest.approx(0.1, rel=0.065)
    assert np.nanstd(found[:, 430:]) == pytest.approx(0.1 * np.sqrt(5.0), rel=0.065)


def test_the_pull_is_towards_whole_disparities(rng):
    noise = NoiseSpec(kind="stereo", disparity_px=0.0, step_px=0.0, locking_px=0.1)
    for part, pulled in ((0.0, 0.0), (0.25, -0.1), (0.5, 0.0), (0.75, 0.1)):
        exact = RIG.depth_m(np.full((20, 80), 20.0 + part))
        found = RIG.disparity_px(modelled_depth_m(exact, checkered((20, 80)), RIG, noise, rng=rng))
        np.testing.assert_allclose(found[:, 30:], 20.0 + part + pulled, atol=1e-9)


def test_the_pulls_of_a_whole_period_within_the_window_cancel():
    disparity_px = np.tile(20.0 + np.arange(70) / 7.0, (9, 1))
    np.testing.assert_allclose(pull(disparity_px, 7)[:, 3:-3], 0.0, atol=1e-12)
