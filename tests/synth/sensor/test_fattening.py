"""Windows that bleed: depth edges moved out of the nearer surface."""

import cv2
import numpy as np
import pytest

from synth.sensor.fattening import fattened_px
from synth.sensor.rig import Rig
from synth.sensor.stereo import modelled_depth_m
from synth.spec import convert_spec
from synth.spec.sensor import NoiseSpec, fattening_px


def test_a_block_grows_by_the_reach_on_every_side():
    disparity_px = np.full((40, 60), 20.0)
    disparity_px[15:25, 20:40] = 30.0
    expected = np.full((40, 60), 20.0)
    expected[12:28, 17:43] = 30.0
    np.testing.assert_array_equal(fattened_px(disparity_px, 3), expected)


def test_a_slope_is_no_edge():
    disparity_px = np.broadcast_to(np.linspace(20.0, 50.0, 40)[:, None], (40, 60)).copy()
    np.testing.assert_array_equal(fattened_px(disparity_px, 15), disparity_px)


def test_what_is_near_grows_into_the_sky():
    disparity_px = np.full((9, 9), np.nan)
    disparity_px[:, :4] = 10.0
    found = fattened_px(disparity_px, 2)
    assert (found[:, :6] == 10.0).all()
    assert np.isnan(found[:, 6:]).all()


def test_the_edge_of_a_measured_block_moves_by_half_a_window(rng):
    rig = Rig(focal_px=1000.0, baseline_m=0.1)
    depth_m = np.full((60, 160), 4.0)
    depth_m[20:40, 90:120] = 3.0
    noise = NoiseSpec(
        kind="stereo", disparity_px=0.0, step_px=0.0, min_texture=0.0, window_px=11, fattening=1.0
    )
    found = modelled_depth_m(depth_m, np.zeros(depth_m.shape), rig, noise, rng=rng)
    assert fattening_px(noise) == 5
    near = np.abs(found - 3.0) < 1e-9
    assert np.flatnonzero(near[30]).tolist() == list(range(85, 125))
    assert np.flatnonzero(near[:, 100]).tolist() == list(range(15, 45))


def matched(rng):
    """Near pixels found by OpenCV: a textured square before a wall of a sixth of its contrast."""
    wide = cv2.GaussianBlur(rng.standard_normal((160, 168)), (0, 0), 1.0)
    wall = 128.0 + 5.0 * wide / wide.std()
    square = cv2.GaussianBlur(rng.standard_normal((80, 80)), (0, 0), 1.0)
    left, right = wall[:, :160].copy(), wall[:, 8:].copy()
    left[40:120, 40:120] = right[40:120, 16:96] = 128.0 + 30.0 * square / square.std()
    matcher = cv2.StereoBM.create(numDisparities=48, blockSize=11)
    matcher.setPreFilterType(cv2.STEREO_BM_PREFILTER_NORMALIZED_RESPONSE)
    matcher.setTextureThreshold(0)
    matcher.setUniquenessRatio(0)
    noisy = [one + rng.standard_normal(one.shape) for one in (left, right)]
    return matcher.compute(*(np.rint(one).clip(0, 255).astype(np.uint8) for one in noisy)) > 256


def test_edges_move_as_those_of_a_block_matcher_in_rows_and_in_columns(rng):
    exact = np.full((160, 160), 8.0)
    exact[40:120, 40:120] = 24.0
    noise = NoiseSpec(kind="stereo", window_px=11, fattening=0.6)
    model = fattened_px(exact, fattening_px(noise)) > 16.0
    theirs = np.mean([matched(rng) for _ in range(8)], axis=0)
    for near, within in ((model, 1e-9), (theirs, 0.6)):
        right = near[55:105, 100:140].mean(axis=0).sum() - 20.0
        lower = near[100:140, 55:105].mean(axis=1).sum() - 20.0
        upper = near[20:60, 55:105].mean(axis=1).sum() - 20.0
        assert [right, lower, upper] == pytest.approx([3.0, 3.0, 3.0], abs=within)


def test_a_spec_that_does_not_ask_for_it_has_no_such_key():
    assert fattening_px(NoiseSpec()) == 0
    assert convert_spec({"noise": {"kind": "stereo"}}, where="").noise == NoiseSpec(kind="stereo")
