"""Roundness at a scale: closed forms, invariance, order, and no jumps."""

import numpy as np
import pytest

from synth.rocks.outlines.smoothed import SCALE, inscribed_radius_m, smoothed_roundness

TURN_RAD = 2.0 * np.pi * np.arange(8192) / 8192


def ring(radii):
    return radii[:, None] * np.column_stack([np.cos(TURN_RAD), np.sin(TURN_RAD)])


def rounded_square(radius, *, count=8192):
    """A square of side 2 with corners of a radius, dotted at equal steps of its length."""
    flat = 2.0 * (1.0 - radius)
    side = flat + np.pi * radius / 2.0
    reach = 4.0 * side * np.arange(count) / count
    quarter, along = np.divmod(reach, side)
    turn = np.clip((along - flat) / max(radius, 1e-12), 0.0, np.pi / 2.0)
    x = np.where(along < flat, 1.0, 1.0 - radius + radius * np.cos(turn))
    y = np.where(along < flat, along - flat / 2.0, flat / 2.0 + radius * np.sin(turn))
    cosine, sine = np.cos(quarter * np.pi / 2.0), np.sin(quarter * np.pi / 2.0)
    return np.column_stack([cosine * x - sine * y, sine * x + cosine * y])


def test_a_disc_is_round():
    # Smoothing shrinks both radii alike; 512 chords take 2e-5 of the inscribed disc.
    assert smoothed_roundness(ring(np.ones(8192))) == pytest.approx(1.0, abs=1e-4)


def test_inscribed_discs():
    # Of a square 1; of two lobes the wider one's, though its middle is not the outline's.
    # 512 dots: their chords take less than (2π/512)²/8.
    assert inscribed_radius_m(rounded_square(0.2, count=512)) == pytest.approx(1.0, rel=2e-4)
    lobes = ring(1.0 + 0.3 * np.cos(TURN_RAD) + 0.4 * np.cos(2 * TURN_RAD))[::16]
    disc = inscribed_radius_m(lobes)
    middles = np.column_stack([np.linspace(-1.5, 1.5, 601), np.zeros(601)])
    reach = np.linalg.norm(middles[:, None] - lobes, axis=2).min(axis=1)
    inside = np.abs(middles[:, 0] - 0.5) < 0.9
    assert disc == pytest.approx(reach[inside].max(), rel=1e-3)


def test_a_sharp_corner_takes_the_smoothings_own_radius():
    # A right angle under a normal distribution of deviation σ: x(s) = ∫ Φ, so at the corner both
    # slopes are ½ and both bends ±φ(0)/σ: the curvature is (½ + ½) φ(0)/σ / 2^-1.5 = 2/(σ √π).
    # The neighbouring corners are 28 σ away; the inscribed disc stays 1.
    deviation = SCALE * np.sqrt(4.0 / np.pi)
    expected = deviation * np.sqrt(np.pi) / 2.0
    assert smoothed_roundness(rounded_square(0.0)) == pytest.approx(expected, rel=1e-3)


def test_rounder_squares_are_rounder_and_wide_corners_keep_their_radius():
    found = [smoothed_roundness(rounded_square(r)) for r in (0.0, 0.1, 0.2, 0.4, 0.7, 0.9)]
    assert (np.diff(found) > 0.005).all()
    # A corner much longer than the smoothing's deviation: its radius changes by σ²/ρ² or less.
    assert found[4] == pytest.approx(0.7, rel=0.03)


def test_size_place_and_turn_do_not_matter():
    outline = ring(1.0 + 0.1 * np.cos(3 * TURN_RAD) + 0.02 * np.cos(17 * TURN_RAD + 1.0))
    turned = outline @ np.array([[0.6, -0.8], [0.8, 0.6]]) * 0.03 + [5.0, 2.0]
    found = smoothed_roundness(outline)
    # Coordinates a hundred times the size cost two digits of the curvature's ten.
    assert smoothed_roundness(turned) == pytest.approx(found, rel=1e-5)
    # Starting elsewhere moves the 2048 dots along: the disc's chords, 2e-5.
    rolled = smoothed_roundness(np.roll(outline, 1234, axis=0))
    assert rolled == pytest.approx(found, rel=1e-4)


def test_a_growing_bump_makes_no_jump():
    # A small dent between corners comes up from nothing; steps stay of the order of the change.
    heights = np.linspace(0.0, 0.02, 81)
    base = 1.0 + 0.1 * np.cos(2 * TURN_RAD)
    found = [smoothed_roundness(ring(base + h * np.cos(9 * TURN_RAD))) for h in heights]
    steps = np.abs(np.diff(found))
    assert steps.max() < 0.02
    assert abs(found[-1] - found[0]) > 0.1
