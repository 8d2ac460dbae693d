"""The matcher: shifts it must find, holes it must leave, bands that change nothing."""

import cv2
import numpy as np
import pytest

from synth.sensor import sgm
from synth.sensor.sgm import matched_disparity_px, search_range_px

ROWS, COLS = 120, 260


@pytest.fixture
def pattern(rng):
    """A picture with power at several scales, (rows, cols), wider than a frame."""
    fine = rng.normal(128.0, 60.0, size=(ROWS, COLS + 80))
    return np.clip(cv2.GaussianBlur(fine, (0, 0), 1.2) * 2.0 - 128.0, 0, 255)


def shifted(pattern, disparity_px):
    """Return a frame of the pattern and what a right eye sees of it at one disparity."""
    columns, rows = np.meshgrid(np.arange(COLS) + disparity_px, np.arange(ROWS))
    right = cv2.remap(
        pattern.astype(np.float32),
        columns.astype(np.float32),
        rows.astype(np.float32),
        cv2.INTER_CUBIC,
    )
    return np.rint(pattern[:, :COLS]).astype(np.uint8), np.clip(np.rint(right), 0, 255).astype(
        np.uint8
    )


@pytest.mark.parametrize("disparity_px", [12.0, 20.25, 20.5])
def test_a_shift_is_found_to_a_fraction_of_a_pixel(pattern, disparity_px):
    left, right = shifted(pattern, disparity_px)
    found = matched_disparity_px(left, right, least_px=8, count=32, window_px=7)
    inside = found[8:-8, 30:-8]  # whole windows only
    assert np.isnan(inside).mean() < 0.02
    # Steps are 1/16 px; a parabola through absolute differences pulls to whole pixels, by up to
    # a quarter of one and either way at a half (Shimizu and Okutomi 2001): the middle stays.
    assert abs(np.nanmedian(inside) - disparity_px) < 0.1
    assert np.nanmax(np.abs(inside - disparity_px)) < 0.5


def test_what_leaves_the_right_picture_is_a_hole(pattern):
    left, right = shifted(pattern, 20.0)
    found = matched_disparity_px(left, right, least_px=8, count=32, window_px=7)
    landing = np.arange(COLS) - found
    assert not (landing < -0.5).any()


def test_bands_of_rows_change_little(pattern, monkeypatch):
    left, right = shifted(pattern, 16.0)
    whole = matched_disparity_px(left, right, least_px=8, count=32, window_px=7)
    monkeypatch.setattr(sgm, "_MAX_BYTES", 0)  # bands of the overlap's height
    banded = matched_disparity_px(left, right, least_px=8, count=32, window_px=7)
    both = ~np.isnan(whole) & ~np.isnan(banded)
    assert both.mean() > 0.85
    # Costs travel along paths; from 48 rows away next to nothing is left of them.
    assert np.mean(np.abs(whole - banded)[both] > 0.125) < 0.01


def test_search_range_holds_the_scene_and_is_a_multiple_of_16():
    low, count = search_range_px(np.array([[40.0, 90.0, np.nan]]))
    assert low <= 40
    assert low + count > 90
    assert count % 16 == 0
    assert search_range_px(np.array([[0.5]]))[0] == 0


def test_steps_are_rounded_to_the_nearest(pattern):
    # OpenCV cuts towards zero: what lies below a whole disparity by 4 steps comes out 3 below.
    # A shift by a quarter and by three quarters are each other's mirror image, so their errors
    # are opposite, where a cut leaves both 1/32 px too great.
    errors_px = []
    for disparity_px in (20.25, 20.75):
        left, right = shifted(pattern, disparity_px)
        found = matched_disparity_px(left, right, least_px=8, count=32, window_px=7)
        errors_px.append(np.nanmean(found[8:-8, 30:-8]) - disparity_px)
    assert abs(sum(errors_px)) / 2.0 < 0.01
