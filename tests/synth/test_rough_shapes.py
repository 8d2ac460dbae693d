"""Rough and jagged drawn shapes: what lies on the outline, apart from the outline's own truth."""

from itertools import pairwise

import cv2
import numpy as np
import pytest

import synth
from synth.errors import SpecError
from synth.shapes.draw import draw_named_series
from synth.shapes.roughness import Roughness, rough_outline


def circle(radius_px):
    """Return points half a pixel apart on a circle."""
    turn = np.linspace(0.0, 2.0 * np.pi, round(4.0 * np.pi * radius_px), endpoint=False)
    return radius_px * np.column_stack([np.cos(turn), np.sin(turn)])


@pytest.mark.parametrize("radius_px", [15.0, 80.0, 500.0])
def test_waves_have_the_stated_rms_and_wavelengths(radius_px):
    waves = Roughness("waves", 0.03)
    rough = rough_outline(circle(radius_px), radius_px, waves, np.random.default_rng(2))
    heights = np.linalg.norm(rough.points_px - circle(radius_px).mean(axis=0), axis=1) - radius_px
    assert np.sqrt(np.mean(heights**2)) == pytest.approx(0.03 * radius_px, rel=0.02)
    assert rough.rms_px == pytest.approx(0.03 * radius_px, rel=1e-9)
    power = np.abs(np.fft.rfft(heights)) ** 2
    length_px = 0.5 * len(heights)
    present = np.flatnonzero(power > 1e-3 * power.max())
    low_px, high_px = rough.wavelengths_px
    assert length_px / present.min() <= high_px * 1.01
    assert length_px / present.max() >= low_px * 0.99
    assert high_px / low_px > 2.0 * (4.0 if radius_px > 20.0 else 1.0)


def test_teeth_are_cut_in_and_leave_the_tips_on_the_outline():
    teeth = Roughness("teeth", 0.2)
    rough = rough_outline(circle(80.0), 80.0, teeth, np.random.default_rng(3))
    radii = np.linalg.norm(rough.points_px, axis=1)
    assert radii.max() == pytest.approx(80.0, abs=0.05)
    valleys = radii[4 : len(radii) // 8 * 8 : 8]
    assert (80.0 - valleys).mean() == pytest.approx(16.0, rel=0.05)
    assert rough.wavelengths_px == (4.0, 4.0)


def test_the_rough_series_keeps_the_roundness_of_its_smooth_outlines():
    smooth, rough = (
        synth.make_shapes(name, count=4, seed=5).truth for name in ("roundness", "rough")
    )
    for column in ("roundness", "corner_radius_px", "area_px2", "perimeter_px"):
        np.testing.assert_array_equal(rough[column], smooth[column])
    assert (rough.rough_perimeter_px > smooth.perimeter_px).all()
    np.testing.assert_allclose(rough.rough_area_px2, smooth.area_px2, rtol=0.02)


def test_the_rippled_series_is_one_outline_under_waves_of_the_knobs_height():
    truth = synth.make_shapes("rippled", knobs=[0.0, 0.01, 0.04], seed=5, size_px=300.0).truth
    assert truth.roundness.nunique() == truth.area_px2.nunique() == 1
    heights = truth.roughness_rms_px / np.sqrt(truth.area_px2 / np.pi)
    np.testing.assert_allclose(heights, [0.0, 0.01, 0.04], rtol=1e-9)
    with pytest.raises(SpecError, match=r"knobs: expected 0 to 0.05 for rippled, found 0.06"):
        synth.make_shapes("rippled", knobs=[0.06])


def test_labels_hold_the_rough_outlines_area():
    for series in ("rough", "rippled", "jagged"):
        shapes = synth.make_shapes(series, count=3, seed=1, size_px=300.0, jitter_rms_px=0.0)
        counted = np.bincount(shapes.labels.ravel())[1:]
        np.testing.assert_allclose(counted, shapes.truth.rough_area_px2, rtol=5e-3)


@pytest.mark.parametrize("size_px", [30.0, 200.0, 1000.0])
@pytest.mark.parametrize("series", ["roundness", "sphericity", "both"])
def test_size_and_turn_move_nothing_but_size_and_turn(series, size_px):
    plain = synth.make_shapes(series, count=2, seed=7)
    moved = synth.make_shapes(
        series, count=2, seed=7, size_px=size_px, turn_deg=25.0, jitter_rms_px=0.0
    )
    for column in ("roundness", "rectangle_ratio", "knob"):
        np.testing.assert_allclose(moved.truth[column], plain.truth[column], rtol=1e-9)
    for label in (1, 2):
        rows, cols = np.nonzero(moved.labels == label)
        points = np.column_stack([cols, rows]).astype(np.float32)
        _, sides, _ = cv2.minAreaRect(points)
        assert max(sides) + 1.0 == pytest.approx(size_px, abs=2.0)
        assert len(rows) == pytest.approx(moved.truth.area_px2[label - 1], rel=0.03)


def test_turned_corners_are_the_corners_turned():
    plain, turned = (
        draw_named_series("both", count=1, seed=2, turn_deg=angle)[0][0] for angle in (0.0, 90.0)
    )
    quarter = np.column_stack([-plain.outline.corners_px[:, 1], plain.outline.corners_px[:, 0]])
    np.testing.assert_allclose(turned.outline.corners_px, quarter, atol=1e-9)


def test_sizes_and_turns_out_of_range_are_refused():
    with pytest.raises(SpecError, match="size_px: expected 30 to 1000 px, found 20"):
        synth.make_shapes("rough", size_px=20.0)
    with pytest.raises(SpecError, match="turn_deg: expected -360 to 360 degrees, found 400"):
        synth.make_shapes("rough", turn_deg=400.0)


@pytest.mark.parametrize(("size_px", "bands"), [(30.0, 3), (100.0, 4), (300.0, 5), (1000.0, 5)])
def test_silhouettes_are_rough_at_several_wavelengths_at_any_size(size_px, bands):
    shapes, drawing = draw_named_series(
        "rough", knobs=[0.4], seed=4, size_px=size_px, jitter_rms_px=0.0
    )
    row, outline = drawing.rows[0], shapes[0].outline
    # Heights over the smooth outline, along the rays on which the waves were laid.
    closed = np.vstack([outline.outline_px(), outline.outline_px()[:1]])
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    even = np.linspace(0.0, along[-1], 20_000, endpoint=False)
    smooth = np.column_stack([np.interp(even, along, part) for part in closed.T])
    smooth = smooth * [1.0, -1.0] + drawing.middles_px[0]
    middle = smooth.mean(axis=0)
    turn = np.linspace(-np.pi, np.pi, 2048, endpoint=False)

    def radii(points):
        arms = points - middle
        bearing = np.arctan2(arms[:, 1], arms[:, 0])
        order = np.argsort(bearing)
        return np.interp(
            turn, bearing[order], np.linalg.norm(arms, axis=1)[order], period=2.0 * np.pi
        )

    heights = radii(drawing.drawn_px[0]) - radii(smooth)
    assert np.sqrt(np.mean(heights**2)) == pytest.approx(row["roughness_rms_px"], rel=0.15)
    # Octaves of wavelength from 2 √(A/π) down that hold a hundredth of the power at least.
    power = np.abs(np.fft.rfft(heights)) ** 2
    first = outline.perimeter_px() / (2.0 * np.sqrt(outline.area_px2() / np.pi))
    edges = first * 2.0 ** (np.arange(bands + 1) - 0.5)
    shares = [
        power[int(np.ceil(low)) : int(high) + 1].sum() / power[1:].sum()
        for low, high in pairwise(edges)
    ]
    assert min(shares) > 0.01
    # The labels, pixels whose centres the pen enclosed, are as rough.
    assert (drawing.labels > 0).sum() == pytest.approx(row["rough_area_px2"], rel=0.03)


@pytest.mark.parametrize("size_px", [30.0, 200.0, 1000.0])
@pytest.mark.parametrize("series", ["rough", "rippled", "jagged"])
def test_roundness_of_rough_shapes_is_that_of_the_form_under_them(series, size_px):
    # Wadell's: all corners have one radius; the inscribed disc is sought in pixels of the form
    # itself, drawn 1600 px long, whose distance transform is good to a pixel of some 500.
    shapes, drawing = draw_named_series(series, count=2, seed=6, size_px=size_px)
    for shape, row in zip(shapes, drawing.rows, strict=True):
        assert row["roundness"] == shape.outline.roundness()
        large = shape.placed(size_px=1600.0, turn_deg=0.0).outline
        points = large.outline_px() - large.outline_px().min(axis=0) + 3.0
        mask = np.zeros(np.ceil(points.max(axis=0)).astype(int)[::-1] + 4, np.uint8)
        cv2.fillPoly(mask, [np.rint(points * 256.0).astype(np.int32)], 1, cv2.LINE_8, 8)
        disc_px = cv2.distanceTransform(mask, cv2.DIST_L2, cv2.DIST_MASK_PRECISE).max()
        assert row["roundness"] == pytest.approx(large.radius_px / disc_px, rel=5e-3)
